// Reconnecting.h - a device that can be opened again, by its identity, after it was unplugged or failed: what an
// explicit reset asks of it.
//
// A stimulator does not need it: it looks for its device when its status is asked for. Nor has a device whose calls
// fail only as long as the cause lasts.
//
// Thread-safety: the device's session thread.
#pragma once

#include "core/base/Result.h"

namespace tacto {

class Reconnecting {
public:
    virtual ~Reconnecting() = default;
    /// Opens the same device wherever it is plugged in now; after success it works as after its first opening. May wait
    /// for answers, about a second. Errors: NotFound (not plugged in); as opening it; Device where what comes back is
    /// not what it was.
    [[nodiscard]] virtual Result<void> reconnect() = 0;
};

}  // namespace tacto
