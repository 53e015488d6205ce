// Acquisition.h - what an instrument's thread does: opens it, and takes records until the arming they are for ends.
//
// Thread-safety: open(), acquire() and `instrument` belong to the instrument's thread; `abilities` and `wiring` are
// constant once open() has come back; the rest any thread.
#pragma once

#include <atomic>
#include <memory>

#include "core/base/Clock.h"
#include "drivers/sigrok/driver/Instrument.h"
#include "drivers/sigrok/protocol/CaptureQueue.h"
#include "drivers/sigrok/protocol/RawRecord.h"

namespace tacto::sigrok_driver {

class Acquisition {
public:
    /// `clock` is asked only until `closing`.
    explicit Acquisition(const Clock& clock) : clock_(clock) {}

    /// Errors: as Instrument::open(), wire() and Instrument::prepare().
    [[nodiscard]] Result<void> open(const ScopeUri& uri,
                                    const std::vector<std::pair<std::string, std::string>>& options);
    /// Takes records into `queue` until arming `number` ends or something goes wrong, which is queue.error() then.
    void acquire(const RecordPlan& plan, std::uint64_t number) noexcept;

    CaptureQueue queue;
    std::atomic<bool> closing{false};
    Abilities abilities;
    Wiring wiring;
    std::unique_ptr<Instrument> instrument;

private:
    [[nodiscard]] Result<void> acquireFrames(const RecordPlan& plan, std::uint64_t number);
    [[nodiscard]] Result<void> acquireStream(const RecordPlan& plan, std::uint64_t number);
    /// One frame: complete, or nothing when the arming ended. Errors: Device.
    [[nodiscard]] Result<std::optional<RawRecord>> takeFrame(const RecordPlan& plan, std::uint64_t number);
    [[nodiscard]] double now() const noexcept { return closing ? 0 : toSeconds(clock_.now()); }

    const Clock& clock_;
};

}  // namespace tacto::sigrok_driver
