#include "drivers/sensor_board/UsbSensorBoards.h"

#include "drivers/usb/UsbBulkTransport.h"

namespace tacto {

namespace {

/// A second of a board's stream, and room for a faster one.
constexpr std::size_t kRingBytes = 128 * 1024;

class UsbSensorBoards final : public SensorBoardPorts {
public:
    UsbSensorBoards(std::shared_ptr<UsbContext> context, OpenTerminal openTerminal)
        : context_(std::move(context)), openTerminal_(std::move(openTerminal)) {}

    std::vector<SensorBoardPort> list() const override {
        std::vector<SensorBoardPort> found;
        for (const auto& device : boards()) found.push_back({device.serial, device.path, device.obstacle()});
        return found;
    }

    Result<std::unique_ptr<Transport>> open(const SensorBoardPort& port) override {
        for (const auto& device : boards()) {
            if (device.path != port.place || device.serial != port.serial) continue;
            UsbBulkOptions options;
            options.ringBytes = kRingBytes;
            auto opened = UsbBulkTransport::open(context_, device, options);
            if (!opened && opened.error().code == ErrorCode::Unsupported) {
                options.function = UsbFunction::Vendor;  // PROTOCOL.md, section 1: either will do
                opened = UsbBulkTransport::open(context_, device, options);
            }
            if (!opened) return failure(opened);
            return std::unique_ptr<Transport>(std::move(*opened));
        }
        return fail(ErrorCode::NotFound, "the sensor board \"{}\" at {} is not plugged in any more", port.serial,
                    port.place);
    }

    Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) override {
        if (openTerminal_) return openTerminal_(path);
        return fail(ErrorCode::Unsupported, "this program opens no terminals, and tty={} is one", path);
    }

private:
    std::vector<UsbDeviceInfo> boards() const {
        std::vector<UsbDeviceInfo> found;
        if (!context_) return found;
        for (auto& device : context_->devices()) {
            if (!device.is({kSensorBoardVendor, kSensorBoardProduct})) continue;
            if (device.name == kSensorBoardName) found.push_back(std::move(device));
        }
        return found;
    }

    const std::shared_ptr<UsbContext> context_;
    const OpenTerminal openTerminal_;
};

}  // namespace

std::shared_ptr<SensorBoardPorts> makeUsbSensorBoards(std::shared_ptr<UsbContext> context, OpenTerminal openTerminal) {
    return std::make_shared<UsbSensorBoards>(std::move(context), std::move(openTerminal));
}

}  // namespace tacto
