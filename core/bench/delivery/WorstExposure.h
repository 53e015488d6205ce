// WorstExposure.h - the largest value that each row of the exposure table has had during an order. Trivially copyable.
// Where limits of a set on one quantity differ by frequency it is the one that was in force then.
//
// Thread-safety: a value; the control loop adds to it and publishes it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/bench/Telemetry.h"

namespace tacto {

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

}  // namespace tacto
