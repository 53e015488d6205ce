#include "drivers/usb/UsbControl.h"

#include <array>

#include "drivers/usb/UsbOutbox.h"

namespace tacto {

namespace {

constexpr std::uint8_t kInput = 0x80;

/// Returns the SETUP packet (USB 2.0 section 9.3): little-endian, no data.
std::array<std::uint8_t, 8> setupOf(const UsbRequest& request, std::uint16_t value) noexcept {
    return {request.type,
            request.request,
            static_cast<std::uint8_t>(value),
            static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint8_t>(request.index),
            static_cast<std::uint8_t>(request.index >> 8),
            0,
            0};
}

}  // namespace

struct UsbControl::Parts {
    Parts(std::shared_ptr<UsbDevice> opened, const UsbRequest& asked)
        : device(std::move(opened)), request(asked), outbox(*device, line, 0) {}

    const std::shared_ptr<UsbDevice> device;
    const UsbRequest request;
    UsbLine line;
    UsbOutbox outbox;
};

Result<std::unique_ptr<UsbControl>> UsbControl::open(std::shared_ptr<UsbContext> context, const UsbDeviceInfo& info,
                                                     const UsbRequest& request) {
    if ((request.type & kInput) != 0) {
        return fail(ErrorCode::InvalidArgument, "{}: request type {:#04x} is for input; bit 7 clear was expected",
                    info.label(), request.type);
    }
    auto device = UsbDevice::open(std::move(context), info);
    if (!device) return failure(device);
    if (auto claimed = (*device)->claim(0); !claimed) return failure(claimed);
    return std::unique_ptr<UsbControl>(new UsbControl(std::make_unique<Parts>(std::move(*device), request)));
}

UsbControl::UsbControl(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
UsbControl::~UsbControl() = default;

Result<void> UsbControl::send(std::uint16_t value, Seconds timeout) {
    return parts_->outbox.send(setupOf(parts_->request, value), timeout);
}

void UsbControl::sendUrgent(std::uint16_t value) noexcept {
    parts_->outbox.sendUrgent(setupOf(parts_->request, value));
}

std::uint64_t UsbControl::urgentDelivered() const noexcept { return parts_->outbox.delivered(); }
const UsbDeviceInfo& UsbControl::info() const noexcept { return parts_->device->info(); }

}  // namespace tacto
