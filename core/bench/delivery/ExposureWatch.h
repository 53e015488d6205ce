// ExposureWatch.h - what the gate has booked, as displays see it: the table of now, ten times a second and after each
// train, and the largest of each row since the order began.
//
// Thread-safety: beginOrder(), show() and worst() any thread; the rest has one caller, the control loop. Never
// allocates after construction.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

#include "core/base/Latest.h"
#include "core/bench/delivery/WorstExposure.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

class ExposureWatch {
public:
    /// `gate` outlives this.
    explicit ExposureWatch(const SafetyGate& gate) : gate_(gate) { rows_.reserve(kMaxExposureRows); }

    /// The worst is of another order from the next look on.
    void beginOrder() noexcept { anotherOrder_.store(true, std::memory_order_release); }
    /// A window is fullest when a train has just been booked: the next look() is one.
    void lookNext() noexcept { at_ = Instant(0); }
    /// Where a look is due. `measured` stands beside what was commanded.
    void look(Instant now, const MeasuredOutput& measured) noexcept;

    /// The table of the last look, into `all`.
    void show(Telemetry& all) const noexcept;
    [[nodiscard]] WorstExposure worst() const noexcept { return latestWorst_.read(); }

private:
    struct Table {
        std::array<ExposureRow, kMaxExposureRows> rows{};
        std::size_t count = 0;
    };

    const SafetyGate& gate_;
    std::atomic<bool> anotherOrder_{false};  // and worst_ is of the one before
    // The loop's own:
    std::vector<ExposureRow> rows_;
    Instant at_{0};
    Table now_;
    Latest<Table> latestNow_;
    WorstExposure worst_;
    Latest<WorstExposure> latestWorst_;
};

}  // namespace tacto
