// The libusb build of hidapi, under the names that CMakeLists.txt gives it.
#include "drivers/hid_massager/HidapiCalls.h"

extern "C" {
hid_device_info* tacto_usb_hid_enumerate(unsigned short vendor, unsigned short product);
void tacto_usb_hid_free_enumeration(hid_device_info* list);
hid_device* tacto_usb_hid_open_path(const char* path);
int tacto_usb_hid_write(hid_device* device, const unsigned char* data, std::size_t length);
int tacto_usb_hid_get_feature_report(hid_device* device, unsigned char* data, std::size_t length);
const wchar_t* tacto_usb_hid_error(hid_device* device);
void tacto_usb_hid_close(hid_device* device);
}

namespace tacto::hid {

const HidapiCalls& libusbCalls() noexcept {
    static constexpr HidapiCalls kCalls{
        tacto_usb_hid_enumerate, tacto_usb_hid_free_enumeration,   tacto_usb_hid_open_path,
        tacto_usb_hid_write,     tacto_usb_hid_get_feature_report, tacto_usb_hid_error,
        tacto_usb_hid_close};
    return kCalls;
}

}  // namespace tacto::hid
