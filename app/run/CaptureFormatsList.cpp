#include "app/run/CaptureFormatsList.h"

namespace tacto {

std::shared_ptr<const CaptureFormats> captureFormats() {
    static const std::shared_ptr<const CaptureFormats> all = [] {
        auto formats = std::make_shared<CaptureFormats>();
        addOwnFormats(*formats);
        return formats;
    }();
    return all;
}

}  // namespace tacto
