// UsbError.h - turns libusb's error codes into sentences that name the device, what was tried, and what happened.
//
// Thread-safety: pure functions.
#pragma once

#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// `code` is a negative LIBUSB_ERROR_... Returns Timeout for LIBUSB_ERROR_TIMEOUT, Io if the operating system refuses
/// (not permitted, in use), otherwise Device.
[[nodiscard]] Error usbError(int code, std::string_view device, std::string_view what);

/// `status` tells how a transfer ended: a libusb_transfer_status other than completed.
[[nodiscard]] Error usbTransferError(int status, std::string_view device, std::string_view what);

}  // namespace tacto
