// HidapiBackend.h - HID devices through hidapi over hidraw, which leaves a device to the kernel's driver as well.
//
// Thread-safety: any thread.
#pragma once

#include <memory>

#include "drivers/hid_massager/HidBackend.h"

namespace tacto::hid {

[[nodiscard]] std::shared_ptr<const HidBackend> hidapiBackend();

}  // namespace tacto::hid
