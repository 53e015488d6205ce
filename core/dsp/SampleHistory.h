// SampleHistory.h - holds the last few seconds of a stream in contiguous memory.
//
// Samples keep their numbers forever. Released samples are dropped, and the oldest if there is no more room.
//
// Thread-safety: none; one owner. Never allocates after construction.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/base/Stream.h"

namespace tacto {

/// The time of an event that has not happened.
inline constexpr double kInfinity_s = std::numeric_limits<double>::infinity();
/// Decimal stamps are rounded in binary: 0.4 - 0.3 is slightly more than 0.1.
inline constexpr double kStampRounding_s = 1e-9;

class SampleHistory {
public:
    /// Makes room for `capacity` samples of `width` values each.
    SampleHistory(std::size_t width, std::size_t capacity);

    /// Adds a sample, later than the one before; drops the oldest if full.
    void push(double t_s, const double* values) noexcept;
    /// Releases the samples before number `number`.
    void release(std::size_t number) noexcept;
    void clear() noexcept;

    [[nodiscard]] std::size_t begin() const noexcept { return begin_; }
    [[nodiscard]] std::size_t end() const noexcept { return end_; }
    [[nodiscard]] bool empty() const noexcept { return begin_ == end_; }
    [[nodiscard]] double t(std::size_t number) const noexcept { return t_[number - offset_]; }
    /// Returns the stamp of the newest sample so far; -infinity before the first.
    [[nodiscard]] double newest_s() const noexcept { return end_ == 0 ? -kInfinity_s : t(end_ - 1); }
    [[nodiscard]] const double* values(std::size_t number) const noexcept {
        return values_.data() + (number - offset_) * width_;
    }

private:
    std::size_t width_;
    std::size_t capacity_;
    std::vector<double> t_;  // twice the capacity; samples move to the front when the end is reached
    std::vector<double> values_;
    std::size_t offset_ = 0;  // number of the sample at t_[0]
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

// Limits of possible readings. A value beyond the limit is a fault of the recording, whatever the cause, and is left
// out like NaN. Impacts are far below the limit.

/// Returns the largest magnitude that is accepted as a reading (science.md section 1).
[[nodiscard]] constexpr double mostPlausible(StreamUnit unit) noexcept {
    switch (unit) {
        case StreamUnit::MetrePerSecondSquared:
            return 5000;
        case StreamUnit::Newton:
            return 200;
        case StreamUnit::Pascal:
            return 10e6;
        case StreamUnit::Count:
            break;
    }
    return std::numeric_limits<double>::max();
}

}  // namespace tacto
