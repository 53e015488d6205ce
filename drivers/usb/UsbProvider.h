// UsbProvider.h - a program's one USB context, started when it is first asked for.
//
// Thread-safety: any thread.
#pragma once

#include <functional>
#include <memory>

#include "drivers/usb/UsbContext.h"

namespace tacto {

/// Errors: as UsbContext::start(), each time: USB may come later.
using UsbProvider = std::function<Result<std::shared_ptr<UsbContext>>()>;

/// The context lives as long as it or the provider is held.
[[nodiscard]] UsbProvider makeUsbProvider();

}  // namespace tacto
