// Stream.h - sampled data of one kind at one rate, with their original time stamps.
//
// In base because acquisition makes streams and dsp reads them, and neither of them may depend on the other.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Words.h"

namespace tacto {

enum class StreamKind { Acceleration, Force, Taxels };

/// Units after conversion by the reader. Count: uncalibrated values, used unchanged and marked as such.
enum class StreamUnit { MetrePerSecondSquared, Newton, Pascal, Count };

inline constexpr Word<StreamKind> kStreamKinds[] = {
    {"acceleration", StreamKind::Acceleration}, {"force", StreamKind::Force}, {"taxels", StreamKind::Taxels}};
inline constexpr Word<StreamUnit> kStreamUnits[] = {{"m/s2", StreamUnit::MetrePerSecondSquared},
                                                    {"N", StreamUnit::Newton},
                                                    {"Pa", StreamUnit::Pascal},
                                                    {"count", StreamUnit::Count}};
[[nodiscard]] constexpr std::string_view nameOf(StreamKind kind) noexcept { return wordFor(kStreamKinds, kind); }
[[nodiscard]] constexpr std::string_view symbolOf(StreamUnit unit) noexcept { return wordFor(kStreamUnits, unit); }

struct StreamInfo {
    StreamKind kind;
    StreamUnit unit;
    std::size_t channels;  ///< 1 to 3 axes, 1 for force, or the number of taxels
    double rate_hz;        ///< nominal for live data, measured for recordings (science.md section 1)
    std::string name;      ///< the name for people: "fingertip accelerometer"
};

/// Consecutive samples of one stream. A caller that reads in a loop reuses its block, since clear() keeps the memory:
/// steady reading then does not allocate.
struct SampleBlock {
    std::vector<double> t_s;     ///< time stamps, seconds on the session's time base, one per sample
    std::vector<double> values;  ///< sample i, channel c is at [i * channels + c]; in SI units or counts

    [[nodiscard]] std::size_t samples() const noexcept { return t_s.size(); }
    void clear() noexcept {
        t_s.clear();
        values.clear();
    }
};

/// A time interval that includes both ends.
struct TimeInterval {
    double begin_s = 0;
    double end_s = 0;
    [[nodiscard]] bool contains(double t_s) const noexcept { return t_s >= begin_s && t_s <= end_s; }
};

/// The manufacturer's statements about the data, on the time base of the data's stamps.
struct DeclaredIntervals {
    std::optional<TimeInterval> baseline;              ///< the time at rest, without touch
    std::optional<std::vector<TimeInterval>> contact;  ///< times of contact, in order; not set = not stated
};

// Tells a regular time stamp from a gap, a repeated stamp or a clock that was set back.
//
// A stamp is compared with its place on a regular grid, not with the stamp before: jitter below half a step is regular
// (science.md section 1), but one lost sample is always a gap. The grid follows the stamps slowly, so that a nominal
// rate that is wrong by 2 % causes no false gaps.

enum class StampClass {
    First,     ///< the first sample, which cannot be compared
    Regular,   ///< within half a step of its place on the grid
    Gap,       ///< half a step or more too late: samples before this one are missing
    Early,     ///< half a step or more too early, but later than the stamp before
    Repeat,    ///< equal to the stamp before
    Backward,  ///< earlier than the stamp before: the clock was set back
    Invalid,   ///< not a finite number
};

class SampleGrid {
public:
    /// `rate_hz` must be finite and positive.
    explicit SampleGrid(double rate_hz) noexcept : step_(1.0 / rate_hz) {}

    /// Classifies the next stamp and moves the grid. After First, Gap or Early the grid starts again at that stamp; a
    /// Backward, Repeat or Invalid stamp leaves the grid unchanged.
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

    /// The latest valid stamp; -infinity before the first.
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
