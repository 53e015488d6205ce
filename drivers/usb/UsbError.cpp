#include "drivers/usb/UsbError.h"

#include <libusb.h>

#include "drivers/system/Permission.h"

namespace tacto {

namespace {

constexpr const char* kGone = "it was unplugged";
constexpr const char* kStall = "it refused (stall)";
constexpr const char* kOverflow = "it sent more than was asked for";

Error sentence(ErrorCode code, std::string_view device, std::string_view what, std::string_view why) {
    return Error{code, fmt::format("{}: {} failed: {}", device, what, why)};
}

}  // namespace

Error usbError(int code, std::string_view device, std::string_view what) {
    switch (code) {
        case LIBUSB_ERROR_NO_DEVICE:
            return sentence(ErrorCode::Device, device, what, kGone);
        case LIBUSB_ERROR_PIPE:
            return sentence(ErrorCode::Device, device, what, kStall);
        case LIBUSB_ERROR_OVERFLOW:
            return sentence(ErrorCode::Device, device, what, kOverflow);
        case LIBUSB_ERROR_TIMEOUT:
            return sentence(ErrorCode::Timeout, device, what, "no answer in the time allowed");
        case LIBUSB_ERROR_BUSY:
            return sentence(ErrorCode::Io, device, what, "another program uses it; close that program first");
        case LIBUSB_ERROR_ACCESS:
            return sentence(ErrorCode::Io, device, what, "this user may not open it: " + permissionAdvice());
        default:
            return sentence(ErrorCode::Device, device, what, libusb_error_name(code));
    }
}

Error usbTransferError(int status, std::string_view device, std::string_view what) {
    switch (status) {
        case LIBUSB_TRANSFER_NO_DEVICE:
            return sentence(ErrorCode::Device, device, what, kGone);
        case LIBUSB_TRANSFER_STALL:
            return sentence(ErrorCode::Device, device, what, kStall);
        case LIBUSB_TRANSFER_OVERFLOW:
            return sentence(ErrorCode::Device, device, what, kOverflow);
        case LIBUSB_TRANSFER_TIMED_OUT:
        case LIBUSB_TRANSFER_CANCELLED:
            return sentence(ErrorCode::Timeout, device, what, "not in the time allowed");
        default:
            return sentence(ErrorCode::Device, device, what, "the transfer broke off on the bus");
    }
}

}  // namespace tacto
