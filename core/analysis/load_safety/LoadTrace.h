// LoadTrace.h - one channel's record of one train, from its own baseline, and what its samples add up to. Private to
// core/analysis.
//
// Thread-safety: pure functions; a trace does not outlive its capture.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/measure/Capture.h"

namespace tacto {

struct LoadTrace {
    const CaptureChannel* channel = nullptr;
    double dt = 0;       ///< s
    double start_s = 0;  ///< time of sample 0
    double baseline = 0;
    double noise = 0;       ///< s.d. about the baseline
    std::size_t quiet = 0;  ///< samples of the baseline; the train comes after them
    bool clipped = false;   ///< a sample stands at the end of the range

    [[nodiscard]] double at(std::size_t i) const { return static_cast<double>(channel->samples[i]) - baseline; }
    [[nodiscard]] std::size_t size() const { return channel->samples.size(); }
    /// Whether a sample within `aside` of `i` stands at the end of the range.
    [[nodiscard]] bool clippedNear(std::size_t i, std::size_t aside) const noexcept;
    /// Index of the first sample at or after `t_s`, held within the record.
    [[nodiscard]] std::size_t indexAt(double t_s) const noexcept;
};

/// Nothing where the channel is missing, a sample is not finite, or fewer than 8 samples of quiet lie before `onset_s`.
[[nodiscard]] std::optional<LoadTrace> traceOf(const Capture& capture, std::string_view name, double onset_s);

/// Sums over the record after the baseline. SI units of the channel and seconds.
struct TraceSums {
    double peak = 0;       ///< largest magnitude
    double step = 0;       ///< the smaller step to its neighbours: what may stand between two samples
    double integral = 0;   ///< signed
    double magnitude = 0;  ///< ∫|x|
    double squares = 0;    ///< ∫x², noise taken off
};
[[nodiscard]] TraceSums sumsOf(const LoadTrace& trace);

/// ∫ x dt over [from_s, to_s).
[[nodiscard]] double integralOf(const LoadTrace& trace, double from_s, double to_s);
/// Mean over [from_s, to_s); NaN for an empty stretch.
[[nodiscard]] double meanOf(const LoadTrace& trace, double from_s, double to_s);
/// The value at `at_s` of the straight line that fits the samples of [from_s, to_s) best; NaN with fewer than two.
[[nodiscard]] double lineAt(const LoadTrace& trace, double from_s, double to_s, double at_s);
/// ∫ v·i dt after both baselines.
[[nodiscard]] double energyOf(const LoadTrace& voltage, const LoadTrace& current);

}  // namespace tacto
