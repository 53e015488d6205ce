// ExposureWatch.h - what the gate has booked, as displays see it: the table of now, ten times a second and after each
// train, and the largest of each row since the order began.
//
// Thread-safety: beginOrder(), show() and worst() any thread; the rest has one caller, the control loop. Never
// allocates after construction.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/SpscRing.h"
#include "core/bench/Telemetry.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

// The largest value that each row of the exposure table has had during an order. Trivially copyable. Where limits of a
// set on one quantity differ by frequency, the value counts against the limit in force then.

class WorstExposure {
public:
    /// Takes what is larger than before, and what could not be evaluated: once unknown is worse than any number.
    void take(std::span<const ExposureRow> now) noexcept {
        for (const auto& row : now) {
            const auto known = std::span(rows_).first(count_);
            const auto at = std::ranges::find_if(known, [&](const ExposureRow& r) {
                return r.quantity == row.quantity && r.judged == row.judged && r.action == row.action &&
                       r.set.view() == row.set.view();
            });
            if (at != known.end()) {
                const double measured = std::fmax(at->measured, row.measured);
                const bool beyond = at->beyond || row.beyond;
                if (at->evaluated && (!row.evaluated || !(row.value <= at->value))) *at = row;
                at->measured = measured;
                at->beyond = beyond;
            } else if (count_ < rows_.size()) {  // always: the gate refuses more
                rows_[count_++] = row;
            }
        }
    }
    [[nodiscard]] std::span<const ExposureRow> rows() const noexcept { return std::span(rows_).first(count_); }

private:
    std::array<ExposureRow, kMaxExposureRows> rows_{};
    std::size_t count_ = 0;
};

class ExposureWatch {
public:
    /// `gate` outlives this.
    explicit ExposureWatch(const SafetyGate& gate) : gate_(gate) { rows_.reserve(kMaxExposureRows); }

    /// The worst is of another order from the next look on.
    void beginOrder() noexcept { anotherOrder_.store(true, std::memory_order_release); }
    /// A window is fullest when a train has just been booked: the next look() is one.
    void lookNext() noexcept { at_ = Instant(0); }
    /// Looks where a look is due. `measured` stands beside what was commanded.
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
    std::atomic<bool> anotherOrder_{false};  // another order has come, and worst_ belongs to the one before
    // The loop's own:
    std::vector<ExposureRow> rows_;
    Instant at_{0};
    Table now_;
    Latest<Table> latestNow_;
    WorstExposure worst_;
    Latest<WorstExposure> latestWorst_;
};

}  // namespace tacto
