#include "app/run/CaptureFormatsList.h"

#include "drivers/sigrok/session_file/SigrokFormat.h"

namespace tacto {

std::shared_ptr<const CaptureFormats> captureFormats() {
    static const std::shared_ptr<const CaptureFormats> all = [] {
        auto formats = std::make_shared<CaptureFormats>();
        // Stands before our own: plain CSV, the last of them, accepts any text.
        formats->add(std::make_unique<SigrokFormat>());
        addOwnFormats(*formats);
        return formats;
    }();
    return all;
}

}  // namespace tacto
