// BurstFigures.h - what a massager did in one presentation, by an accelerometer on its motor.
//
// What is measured is the acceleration less its mean in the quiet before the first burst (gravity and offset), as a
// magnitude over the axes, so that it does not matter how the board is fastened:
//   noise      root mean square in the quiet
//   strength   root mean square over the burst's own length from its measured onset, less the noise (of the squares)
//   peak       largest magnitude until the next burst, or for kRunDown after the command's end
//   onset      the first sample after the command that reaches a tenth of the peak, or kAboveNoise times the noise
//              where that is more
//   latency    onset less command
//   rise       from the onset to the first sample of nine tenths of the peak
//   interval   between the onsets of two bursts that follow each other, mean over the presentation
// A burst moved the motor where its peak exceeds kAboveNoise times the noise. One of which samples are missing was not
// measured: neither moved nor still. What was not measured is NaN, never zero.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"

namespace tacto {

/// Stamps ascend. One acceleration a stamp, in m/s².
struct AccelerationSample {
    double t_s = 0;
    double x = 0, y = 0, z = 0;
};

/// A burst as it was commanded.
struct CommandedBurst {
    double onset_s = 0;
    Seconds duration{0.1};
};

struct BurstFigures {
    std::size_t bursts = 0;       ///< commanded
    std::size_t moved = 0;        ///< bursts in which the motor moved
    std::size_t missed = 0;       ///< bursts that were not measured
    double strength_m_s2 = kNaN;  ///< means over those that moved
    double latency_s = kNaN;
    double rise_s = kNaN;
    double interval_s = kNaN;
    double noise_m_s2 = kNaN;  ///< noise of one sample
    /// Standard uncertainties of what is said above, by noise and sampling. The accelerometer's scale is not in them:
    /// it is the same for all conditions, and only ratios are judged.
    double strengthUncertainty_m_s2 = kNaN;
    double intervalUncertainty_s = kNaN;

    static constexpr double kAboveNoise = 5;
    static constexpr Seconds kRunDown{0.1};
    static constexpr Seconds kMinQuiet{0.1};
};

/// `samples` begin at least kMinQuiet before the first burst and end after the last. A gap of more than three sample
/// periods is where samples are missing.
/// Errors: InvalidArgument for no bursts, bursts that do not ascend, a duration that is not above 0, stamps that do not
/// ascend or are not finite; NotFound where the quiet before the first burst was not measured.
[[nodiscard]] Result<BurstFigures> burstFigures(std::span<const AccelerationSample> samples,
                                                std::span<const CommandedBurst> bursts);

}  // namespace tacto
