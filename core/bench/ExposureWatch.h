// ExposureWatch.h - what the gate has booked, as displays see it: the table of now, ten times a second and after each
// train, and the largest of each row since the order began.
//
// Thread-safety: beginOrder() and worst() any thread; the rest has one caller, the control loop. Never allocates after
// construction.
#pragma once

#include <atomic>
#include <vector>

#include "core/base/Latest.h"
#include "core/bench/WorstExposure.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

class ExposureWatch {
public:
    /// `gate` outlives this.
    explicit ExposureWatch(const SafetyGate& gate) : gate_(gate) { rows_.reserve(2 * Telemetry::kMaxExposureRows); }

    /// The worst is of another order from the next look on.
    void beginOrder() noexcept { anotherOrder_.store(true, std::memory_order_release); }
    /// A window is fullest when a train has just been booked: the next look() is one.
    void lookNext() noexcept { at_ = Instant(0); }
    /// Into `shown`, where a look is due.
    void look(Instant now, Telemetry& shown) noexcept;

    [[nodiscard]] WorstExposure worst() const noexcept { return latestWorst_.read(); }

private:
    const SafetyGate& gate_;
    std::atomic<bool> anotherOrder_{false};  // and worst_ is of the one before
    // The loop's own:
    std::vector<ExposureRow> rows_;
    Instant at_{0};
    WorstExposure worst_;
    Latest<WorstExposure> latestWorst_;
};

}  // namespace tacto
