#include "app/run/CaptureFormatsList.h"

#include "drivers/sigrok/session_file/SigrokFormat.h"

namespace tacto {

std::shared_ptr<const CaptureFormats> captureFormats() {
    static const std::shared_ptr<const CaptureFormats> all = [] {
        auto formats = std::make_shared<CaptureFormats>();
        // Added before our own formats, because the last of them, plain CSV, accepts any text.
        formats->add(std::make_unique<SigrokFormat>());
        addOwnFormats(*formats);
        return formats;
    }();
    return all;
}

}  // namespace tacto
