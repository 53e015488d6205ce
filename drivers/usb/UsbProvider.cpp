#include "drivers/usb/UsbProvider.h"

#include <mutex>

namespace tacto {

UsbProvider makeUsbProvider() {
    struct Shared {
        std::mutex mutex;
        std::shared_ptr<UsbContext> context;  // guarded by mutex
    };
    return [shared = std::make_shared<Shared>()]() -> Result<std::shared_ptr<UsbContext>> {
        const std::scoped_lock lock(shared->mutex);
        if (shared->context) return shared->context;
        auto started = UsbContext::start();
        if (!started) return failure(started);
        return shared->context = std::move(*started);
    };
}

}  // namespace tacto
