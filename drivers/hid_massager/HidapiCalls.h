// HidapiCalls.h - hidapi's functions, of whichever build of it. Inside drivers/hid_massager only.
#pragma once

#include <cstddef>
#include <hidapi/hidapi.h>

namespace tacto::hid {

struct HidapiCalls {
    hid_device_info* (*enumerate)(unsigned short, unsigned short);
    void (*freeEnumeration)(hid_device_info*);
    hid_device* (*openPath)(const char*);
    int (*write)(hid_device*, const unsigned char*, std::size_t);
    int (*getFeature)(hid_device*, unsigned char*, std::size_t);
    const wchar_t* (*error)(hid_device*);
    void (*close)(hid_device*);
};

[[nodiscard]] const HidapiCalls& hidrawCalls() noexcept;
[[nodiscard]] const HidapiCalls& libusbCalls() noexcept;

}  // namespace tacto::hid
