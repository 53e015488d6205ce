// ExposureWatch.h - the exposure that the gate has recorded, for displays: the present table, ten times a second and
// after each train, and the largest value of each row since the order began.
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

// The largest value of each row of the exposure table during an order. Trivially copyable. If a set limits one
// quantity differently by frequency, the value is compared with the limit in force at that time.

class WorstExposure {
public:
    /// Keeps larger values than before. A row that could once not be evaluated outranks any number.
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
            } else if (count_ < rows_.size()) {  // always true: the gate refuses more rows
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
    /// `gate` outlives this object.
    explicit ExposureWatch(const SafetyGate& gate) : gate_(gate) { rows_.reserve(kMaxExposureRows); }

    /// Starts the worst table anew for another order, at the next look().
    void beginOrder() noexcept { anotherOrder_.store(true, std::memory_order_release); }
    /// Makes the next look() due at once: exposure in a window peaks just after a train was recorded.
    void lookNext() noexcept { at_ = Instant(0); }
    /// Takes the table if a look is due. `measured` is added to the commanded values.
    void look(Instant now, const MeasuredOutput& measured) noexcept;

    /// Copies the table of the last look into `all`.
    void show(Telemetry& all) const noexcept;
    [[nodiscard]] WorstExposure worst() const noexcept { return latestWorst_.read(); }

private:
    struct Table {
        std::array<ExposureRow, kMaxExposureRows> rows{};
        std::size_t count = 0;
    };

    const SafetyGate& gate_;
    std::atomic<bool> anotherOrder_{false};  // true if a new order has begun and worst_ is the previous order's
    // Used by the loop only:
    std::vector<ExposureRow> rows_;
    Instant at_{0};
    Table now_;
    Latest<Table> latestNow_;
    WorstExposure worst_;
    Latest<WorstExposure> latestWorst_;
};

}  // namespace tacto
