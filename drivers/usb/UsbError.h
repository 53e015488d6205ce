// UsbError.h - libusb's error codes as sentences. An error names the device, what was tried, and what happened.
//
// Thread-safety: pure functions.
#pragma once

#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// `code` is a LIBUSB_ERROR_..., negative. Timeout for LIBUSB_ERROR_TIMEOUT, Io where the operating system refuses
/// (not permitted, in use), Device for all else.
[[nodiscard]] Error usbError(int code, std::string_view device, std::string_view what);

/// `status` is how a transfer ended: an enum libusb_transfer_status other than completed.
[[nodiscard]] Error usbTransferError(int status, std::string_view device, std::string_view what);

}  // namespace tacto
