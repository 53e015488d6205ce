// UsbProvider.h - the program's only USB context, started when first asked for.
//
// Thread-safety: any thread.
#pragma once

#include <functional>
#include <memory>

#include "drivers/usb/UsbContext.h"

namespace tacto {

/// Errors: as UsbContext::start(). Each call tries again, because USB may become available later.
using UsbProvider = std::function<Result<std::shared_ptr<UsbContext>>()>;

/// The context lives as long as the context itself or the provider is held.
[[nodiscard]] UsbProvider makeUsbProvider();

}  // namespace tacto
