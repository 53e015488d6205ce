#include "drivers/sensor_board/UsbSensorBoards.h"

#include "drivers/usb/UsbPorts.h"

namespace tacto {

namespace {

/// Holds a second of a board's stream, with room for a faster board.
constexpr std::size_t kRingBytes = 128UL * 1024;

class UsbSensorBoards final : public SensorBoardPorts {
public:
    UsbSensorBoards(UsbProvider usb, OpenTerminal openTerminal)
        : boards_(makeUsbPorts(std::move(usb), {{kSensorBoardVendor, kSensorBoardProduct, kSensorBoardName}},
                               {.ringBytes = kRingBytes})),
          openTerminal_(std::move(openTerminal)) {}

    std::vector<TransportPort> list() const override { return boards_->list(); }
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override { return boards_->open(port); }
    Result<std::unique_ptr<Transport>> openTerminal(const std::string& path) override {
        if (openTerminal_) return openTerminal_(path);
        return fail(ErrorCode::Unsupported, "this program opens no terminals, and tty={} is one", path);
    }

private:
    const std::shared_ptr<TransportPorts> boards_;
    const OpenTerminal openTerminal_;
};

}  // namespace

std::shared_ptr<SensorBoardPorts> makeUsbSensorBoards(UsbProvider usb, OpenTerminal openTerminal) {
    return std::make_shared<UsbSensorBoards>(std::move(usb), std::move(openTerminal));
}

}  // namespace tacto
