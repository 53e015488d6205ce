// Stream.h - sampled data of one kind at one rate, with the time stamps it came with.
//
// In base because acquisition makes streams, dsp reads them, and the two know nothing of each other.
//
// Thread-safety: values; pure functions.
#pragma once

#include <cstddef>
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
[[nodiscard]] std::string_view nameOf(StreamKind kind) noexcept;
[[nodiscard]] std::string_view symbolOf(StreamUnit unit) noexcept;

struct StreamInfo {
    StreamKind kind;
    StreamUnit unit;
    std::size_t channels;  ///< 1..3 axes, 1 for force, taxel count
    double rate_hz;        ///< nominal where live, measured where recorded (science.md section 1)
    std::string name;      ///< for people: "fingertip accelerometer"
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

/// Both ends belong to it.
struct TimeInterval {
    double begin_s = 0;
    double end_s = 0;
    [[nodiscard]] bool contains(double t_s) const noexcept { return t_s >= begin_s && t_s <= end_s; }
};

/// What the maker of the data states about it, on the same time base as its stamps.
struct DeclaredIntervals {
    std::optional<TimeInterval> baseline;              ///< at rest, nothing touched
    std::optional<std::vector<TimeInterval>> contact;  ///< in time order; absent = not stated
};

}  // namespace tacto
