// TactileSensor.h - a fingertip: streams of acceleration, taxels and force, each with its own rate.
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
    /// Does not change while the device is open.
    [[nodiscard]] virtual std::span<const StreamInfo> streams() const noexcept = 0;

    /// Appends every sample since the last call, up to the present time, to `blocks[i]` for streams()[i].
    /// `blocks.size()` must equal streams().size(). Never blocks; no new samples is success. Values may be NaN and
    /// time stamps may jump: the reader, not this function, judges continuity and range (hazard H7).
    /// Errors: Device if unplugged, or if the data are garbage.
    [[nodiscard]] virtual Result<void> read(std::span<SampleBlock> blocks) = 0;

    /// Returns the intervals of rest and contact that the maker of the data stated, on the session's time base; a live
    /// finger states none.
    [[nodiscard]] virtual DeclaredIntervals declared() const { return {}; }

    /// True if no further sample will come (at the end of a replayed recording).
    [[nodiscard]] virtual bool finished() const noexcept { return false; }
};

/// A rig that can put a surface under the finger by itself; without a rig, the operator is asked to do it.
class SurfacePresenter {
public:
    virtual ~SurfacePresenter() = default;
    /// Slides the finger over `material` (e.g. "glass", "P120") from now on. An empty material lifts the finger.
    /// Errors: InvalidArgument for an unknown material, a negative or non-finite speed or force.
    [[nodiscard]] virtual Result<void> present(std::string_view material, MillimetresPerSecond speed,
                                               Newtons force) = 0;
};

// A device that can be opened again, by its identity, after it was unplugged or failed; an explicit reset uses
// this.
//
// A stimulator does not need this: it searches for its device when its status is read. Nor does a device that works
// again as soon as the cause of its errors is gone.

class Reconnecting {
public:
    virtual ~Reconnecting() = default;
    /// Opens the same device wherever it is plugged in now; it then works as after the first opening. May wait about a
    /// second for answers. Errors: NotFound (not plugged in); as for opening the device; Device if the device that
    /// returns is not the same.
    [[nodiscard]] virtual Result<void> reconnect() = 0;
};

}  // namespace tacto
