// LoadTrace.h - one channel's record of one train, measured from its own baseline, with sums over its samples. Private
// to core/analysis.
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
    double dt = 0;       ///< time between two samples in s
    double start_s = 0;  ///< time of sample 0
    double baseline = 0;
    double noise = 0;       ///< standard deviation around the baseline
    std::size_t quiet = 0;  ///< number of baseline samples before the train
    bool clipped = false;   ///< true if a sample lies at the end of the range

    [[nodiscard]] double at(std::size_t i) const { return static_cast<double>(channel->samples[i]) - baseline; }
    [[nodiscard]] std::size_t size() const { return channel->samples.size(); }
    /// True if a sample within `aside` samples of `i` lies at the end of the range.
    [[nodiscard]] bool clippedNear(std::size_t i, std::size_t aside) const noexcept;
    /// Index of the first sample at or after `t_s`, limited to the record.
    [[nodiscard]] std::size_t indexAt(double t_s) const noexcept;
};

/// Returns nothing if the channel is missing, a sample is not finite, or fewer than 8 quiet samples precede `onset_s`.
[[nodiscard]] std::optional<LoadTrace> traceOf(const Capture& capture, std::string_view name, double onset_s);

/// Sums over the record after the baseline, in the SI unit of the channel and seconds.
struct TraceSums {
    double peak = 0;       ///< largest magnitude
    double step = 0;       ///< smaller step from the peak to a neighbour: what may be hidden between two samples
    double integral = 0;   ///< ∫x, with sign
    double magnitude = 0;  ///< ∫|x|
    double squares = 0;    ///< ∫x² minus the share of the noise
};
[[nodiscard]] TraceSums sumsOf(const LoadTrace& trace);

/// ∫ x dt over [from_s, to_s).
[[nodiscard]] double integralOf(const LoadTrace& trace, double from_s, double to_s);
/// Mean over [from_s, to_s); NaN if no samples lie there.
[[nodiscard]] double meanOf(const LoadTrace& trace, double from_s, double to_s);
/// Value at `at_s` of the best straight line through the samples of [from_s, to_s); NaN with fewer than two samples.
[[nodiscard]] double lineAt(const LoadTrace& trace, double from_s, double to_s, double at_s);
/// ∫ v·i dt over the record after both baseline sections.
[[nodiscard]] double energyOf(const LoadTrace& voltage, const LoadTrace& current);

}  // namespace tacto
