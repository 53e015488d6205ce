#include "drivers/usb/UsbLine.h"

#include <libusb.h>

namespace tacto {

int UsbLine::submit(libusb_transfer* transfer) noexcept {
    if (gone) return LIBUSB_ERROR_NO_DEVICE;
    const int code = libusb_submit_transfer(transfer);
    if (code == LIBUSB_ERROR_NO_DEVICE) {
        gone = true;
        changed.notify_all();
    }
    return code;
}

void FreeTransfer::operator()(libusb_transfer* transfer) const noexcept { libusb_free_transfer(transfer); }

std::optional<std::chrono::steady_clock::time_point> deadlineAfter(Seconds timeout) noexcept {
    if (!(timeout.count() >= 0 && timeout.count() <= 3600)) return std::nullopt;
    return std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(timeout);
}

}  // namespace tacto
