#include "drivers/hid_massager/HidapiCalls.h"

namespace tacto::hid {

const HidapiCalls& hidrawCalls() noexcept {
    static constexpr HidapiCalls kCalls{
        hid_enumerate, hid_free_enumeration, hid_open_path, hid_write, hid_get_feature_report, hid_error, hid_close};
    return kCalls;
}

}  // namespace tacto::hid
