// TactileSensor.h - a fingertip: acceleration, taxels and force, each a stream with its own rate.
//
// Thread-safety: one caller, the device's session thread (on the virtual clock, the control loop).
#pragma once

#include <span>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/devices/Device.h"

namespace tacto {

class TactileSensor : public Device {
public:
    /// Constant while open.
    [[nodiscard]] virtual std::span<const StreamInfo> streams() const noexcept = 0;

    /// Appends every sample since the last call, up to the clock's now, to `blocks[i]` for streams()[i].
    /// `blocks.size()` must equal streams().size(). Never blocks; no samples yet is success. Values may be
    /// NaN and stamps may jump: continuity and range are judged by the reader (hazard H7), not here.
    /// Errors: Device when unplugged or the data are garbage.
    [[nodiscard]] virtual Result<void> read(std::span<SampleBlock> blocks) = 0;

    /// What the maker of the data states about rest and contact, on the session's time base; a live finger states
    /// nothing.
    [[nodiscard]] virtual DeclaredIntervals declared() const { return {}; }

    /// True when no further sample will come (the end of a replayed recording).
    [[nodiscard]] virtual bool finished() const noexcept { return false; }
};

/// A rig that can put a surface under the finger by itself; without it the operator is asked to.
class SurfacePresenter {
public:
    virtual ~SurfacePresenter() = default;
    /// Slides the finger over `material` (e.g. "glass", "P120") from now on. An empty material lifts the finger.
    /// Errors: InvalidArgument for an unknown material, a negative or non-finite speed or force.
    [[nodiscard]] virtual Result<void> present(std::string_view material, MillimetresPerSecond speed,
                                               Newtons force) = 0;
};

// A device that can be opened again, by its identity, after it was unplugged or failed: what an
// explicit reset asks of it.
//
// A stimulator does not need it: it looks for its device when its status is asked for. Neither does a device whose
// calls fail only as long as the cause lasts.

class Reconnecting {
public:
    virtual ~Reconnecting() = default;
    /// Opens the same device wherever it is plugged in now; after success it works as after its first opening. May wait
    /// for answers, about a second. Errors: NotFound (not plugged in); as opening it; Device where what comes back is
    /// not what it was.
    [[nodiscard]] virtual Result<void> reconnect() = 0;
};

}  // namespace tacto
