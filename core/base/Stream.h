// Stream.h - sampled data of one kind at one rate, with the time stamps it came with.
//
// In base because acquisition makes streams, dsp reads them, and the two know nothing of each other.
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

/// Units after conversion on reading. Count: uncalibrated, used as it is and said so.
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
    std::size_t channels;  ///< 1..3 axes, 1 for force, taxel count
    double rate_hz;        ///< nominal where live, measured where recorded (science.md section 1)
    std::string name;      ///< what people read: "fingertip accelerometer"
};

/// Consecutive samples of one stream. A caller that reads in a loop reuses its buffers, so that a steady state
/// does not allocate: clear() keeps capacity.
struct SampleBlock {
    std::vector<double> t_s;     ///< time stamps, seconds on the session's time base, one per sample
    std::vector<double> values;  ///< interleaved: sample i, channel c at [i * channels + c]; SI units or counts

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

/// The maker's statements on the data, on the same time base as its stamps.
struct DeclaredIntervals {
    std::optional<TimeInterval> baseline;              ///< the time at rest, when nothing is touched
    std::optional<std::vector<TimeInterval>> contact;  ///< times of contact, in order; absent = not stated
};

// Tells a regular time stamp from a gap, a repeat or a clock that was set back.
//
// Stamps are compared with the grid they should lie on, not with the stamp before: a jitter of less than
// half a step is regular (science.md section 1), while one lost sample never is. The grid follows the
// stamps slowly, so a nominal rate that is off by 2 % does not drift into false gaps.

enum class StampClass {
    First,     ///< the first sample: nothing to compare with
    Regular,   ///< within half a step of its place on the grid
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

    /// Judges the next stamp and moves the grid. After anything but Regular the grid starts again at that stamp; a
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
