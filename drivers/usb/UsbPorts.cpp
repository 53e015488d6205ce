#include "drivers/usb/UsbPorts.h"

#include <algorithm>

namespace tacto {

namespace {

class UsbPorts final : public TransportPorts {
public:
    UsbPorts(UsbProvider usb, std::vector<UsbProduct> products, const UsbBulkOptions& options)
        : usb_(std::move(usb)), products_(std::move(products)), options_(options) {}

    std::vector<TransportPort> list() const override {
        std::vector<TransportPort> found;
        for (const auto& device : ours()) found.push_back({device.serial, device.path, device.obstacle()});
        return found;
    }

    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override {
        const auto usb = usb_();
        if (!usb) return failure(usb);
        for (const auto& device : ours()) {
            if (device.path != port.place || device.serial != port.serial) continue;
            auto options = options_;
            auto opened = UsbBulkTransport::open(*usb, device, options);
            if (!opened && opened.error().code == ErrorCode::Unsupported && options.function != UsbFunction::Vendor) {
                options.function = UsbFunction::Vendor;
                opened = UsbBulkTransport::open(*usb, device, options);
            }
            if (!opened) return failure(opened);
            return std::unique_ptr<Transport>(std::move(*opened));
        }
        return fail(ErrorCode::NotFound, "the device at {} is not plugged in any more", port.place);
    }

private:
    std::vector<UsbDeviceInfo> ours() const {
        std::vector<UsbDeviceInfo> found;
        const auto usb = usb_();
        if (!usb) return found;
        for (auto& device : (*usb)->devices()) {
            const bool wanted = std::ranges::any_of(products_, [&](const UsbProduct& product) {
                return device.is({product.vendor, product.product}) &&
                       (product.name.empty() || device.name == product.name);
            });
            if (wanted) found.push_back(std::move(device));
        }
        return found;
    }

    const UsbProvider usb_;
    const std::vector<UsbProduct> products_;
    const UsbBulkOptions options_;
};

}  // namespace

std::shared_ptr<TransportPorts> makeUsbPorts(UsbProvider usb, std::vector<UsbProduct> products,
                                             UsbBulkOptions options) {
    return std::make_shared<UsbPorts>(std::move(usb), std::move(products), options);
}

}  // namespace tacto
