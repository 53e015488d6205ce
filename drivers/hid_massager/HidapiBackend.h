// HidapiBackend.h - HID devices through hidapi over hidraw; the kernel's own driver keeps using the device too.
//
// Thread-safety: any thread.
#pragma once

#include <memory>

#include "drivers/hid_massager/HidBackend.h"

namespace tacto::hid {

[[nodiscard]] std::shared_ptr<const HidBackend> hidapiBackend();

}  // namespace tacto::hid
