// Acquisition.h - the work of an instrument's thread: opens the instrument and takes records while it is armed.
//
// Thread-safety: open(), acquire() and `instrument` belong to the instrument's thread; `abilities` and `wiring` are
// constant once open() has returned; any thread may use the rest.
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
    /// `clock` is read only until `closing` is true.
    explicit Acquisition(const Clock& clock) : clock_(clock) {}

    /// Errors: as Instrument::open(), wire() and Instrument::prepare().
    [[nodiscard]] Result<void> open(const ScopeUri& uri,
                                    const std::vector<std::pair<std::string, std::string>>& options);
    /// Puts records into `queue` until arming `number` ends or an error occurs, which queue.error() then returns.
    void acquire(const RecordPlan& plan, std::uint64_t number) noexcept;

    CaptureQueue queue;
    std::atomic<bool> closing{false};
    Abilities abilities;
    Wiring wiring;
    std::unique_ptr<Instrument> instrument;

private:
    [[nodiscard]] Result<void> acquireFrames(const RecordPlan& plan, std::uint64_t number);
    [[nodiscard]] Result<void> acquireStream(const RecordPlan& plan, std::uint64_t number);
    /// Returns one complete frame, or nothing if the arming ended. Errors: Device.
    [[nodiscard]] Result<std::optional<RawRecord>> takeFrame(const RecordPlan& plan, std::uint64_t number);
    [[nodiscard]] double now() const noexcept { return closing ? 0 : toSeconds(clock_.now()); }

    const Clock& clock_;
};

}  // namespace tacto::sigrok_driver
