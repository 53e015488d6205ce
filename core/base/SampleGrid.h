// SampleGrid.h - tells a regular time stamp from a gap, a repeat or a clock that was set back.
//
// Stamps are compared with the grid they should lie on, not with the stamp before: a jitter of less than
// half a step is regular (science.md section 1), while one lost sample never is. The grid follows the
// stamps slowly, so a nominal rate that is off by 2 % does not drift into false gaps.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

#include <cmath>
#include <limits>

namespace tacto {

enum class StampClass {
    First,     ///< nothing to compare with
    Regular,   ///< within half a step of the grid
    Gap,       ///< half a step or more late: samples are missing before this one
    Early,     ///< half a step or more early, yet later than the one before
    Repeat,    ///< the same stamp again
    Backward,  ///< earlier than the one before: the clock was stepped
    Invalid,   ///< not a finite number
};

class SampleGrid {
public:
    /// `rate_hz` must be finite and positive.
    explicit SampleGrid(double rate_hz) noexcept : step_(1.0 / rate_hz) {}

    /// Judges the next stamp and moves the grid. After anything but Regular the grid starts again at that
    /// stamp; a Backward, Repeat or Invalid stamp leaves the grid as it was.
    [[nodiscard]] StampClass next(double t_s) noexcept {
        const double late = t_s - expected_;
        if (t_s > last_ && std::abs(late) < 0.5 * step_) {
            last_ = t_s;
            expected_ += step_ + kFollow * late;
            return StampClass::Regular;
        }
        if (!std::isfinite(t_s)) return StampClass::Invalid;
        if (t_s < last_) return StampClass::Backward;
        if (t_s == last_) return StampClass::Repeat;
        const bool first = std::isinf(last_);
        last_ = t_s;
        expected_ = t_s + step_;
        return first ? StampClass::First : late > 0 ? StampClass::Gap : StampClass::Early;
    }

    /// The newest stamp that moved time forward; -infinity before the first.
    [[nodiscard]] double last() const noexcept { return last_; }
    [[nodiscard]] double step() const noexcept { return step_; }
    void reset() noexcept { last_ = expected_ = -std::numeric_limits<double>::infinity(); }

private:
    static constexpr double kFollow = 0.05;
    double step_;
    double last_ = -std::numeric_limits<double>::infinity();
    double expected_ = -std::numeric_limits<double>::infinity();
};

}  // namespace tacto
