// EvenSteps.h - whether time stamps rise in even steps, decided while they pass by, in constant memory.
//
// Stamp k must lie within `tolerance` steps of first + k * step. Each stamp therefore bounds the step from both sides;
// the step is known only at the end (last - first over their distance) and must then lie between the bounds.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <limits>

namespace tacto {

class EvenSteps {
public:
    explicit EvenSteps(double tolerance) noexcept : tolerance_(tolerance) {}

    void add(double t) noexcept {
        if (count_ == 0) first_ = t;
        const double since = t - first_;
        const auto k = static_cast<double>(count_);
        // Bounds are kept as fractions: a division for every stamp would be most of the work. Written so that a NaN
        // becomes a bound and fails the comparison at the end.
        const double over = k + tolerance_;
        if (!(since * lowUnder_ <= low_ * over)) {
            low_ = since;
            lowUnder_ = over;
        }
        const double under = k - tolerance_;
        if (under > 0 && !(since * highUnder_ >= high_ * under)) {
            high_ = since;
            highUnder_ = under;
        }
        last_ = t;
        ++count_;
    }

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] double first() const noexcept { return first_; }
    [[nodiscard]] double last() const noexcept { return last_; }
    /// Of at least two stamps.
    [[nodiscard]] double step() const noexcept { return (last_ - first_) / static_cast<double>(count_ - 1); }
    /// Whether all stamps fit `step`.
    [[nodiscard]] bool fits(double step) const noexcept {
        constexpr double kRounding = 1e-12;  // of the bounds' own division
        return step > 0 && step >= low_ / lowUnder_ * (1 - kRounding) && step <= high_ / highUnder_ * (1 + kRounding);
    }

private:
    double tolerance_;
    double first_ = 0;
    double last_ = 0;
    double low_ = 0;  // over lowUnder_
    double lowUnder_ = 1;
    double high_ = std::numeric_limits<double>::infinity();  // over highUnder_
    double highUnder_ = 1;
    std::size_t count_ = 0;
};

}  // namespace tacto
