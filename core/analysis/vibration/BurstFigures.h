// BurstFigures.h - what a massager did in one presentation, measured by an accelerometer on its motor.
//
// Each sample is the acceleration minus its mean in the quiet before the first burst (gravity and offset), as a
// magnitude over the axes. The orientation of the board therefore does not matter:
//   noise      root mean square in the quiet
//   strength   root mean square over the burst's own length from its measured onset, after subtraction of the noise
//   squares peak       largest magnitude until the next burst, or for kRunDown after the command's end onset      the
//   first sample after the command that reaches a tenth of the peak, or kAboveNoise times the noise
//              if this is more
//   latency    onset minus command
//   rise       from the onset to the first sample of nine tenths of the peak
//   interval   time between the onsets of two successive bursts, mean over the presentation
// A burst moved the motor if its peak exceeds kAboveNoise times the noise. A burst with missing samples was not
// measured: it is neither moved nor still. A figure that was not measured is NaN, never zero.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"

namespace tacto {

/// One acceleration in m/s² with its time stamp. Time stamps must ascend.
struct AccelerationSample {
    double t_s = 0;
    double x = 0, y = 0, z = 0;
};

/// The onset and duration of a commanded burst.
struct CommandedBurst {
    double onset_s = 0;
    Seconds duration{0.1};
};

struct BurstFigures {
    std::size_t bursts = 0;       ///< number of commanded bursts
    std::size_t moved = 0;        ///< bursts in which the motor moved
    std::size_t missed = 0;       ///< bursts that were not measured
    double strength_m_s2 = kNaN;  ///< strength and the next figures: means over bursts that moved
    double latency_s = kNaN;
    double rise_s = kNaN;
    double interval_s = kNaN;
    double noise_m_s2 = kNaN;  ///< noise of one sample
    /// Standard uncertainties of the figures above, from noise and sampling. They exclude the accelerometer's scale,
    /// which is the same for all conditions, because only ratios are judged.
    double strengthUncertainty_m_s2 = kNaN;
    double intervalUncertainty_s = kNaN;

    static constexpr double kAboveNoise = 5;
    static constexpr Seconds kRunDown{0.1};
    static constexpr Seconds kMinQuiet{0.1};
};

/// `samples` must begin at least kMinQuiet before the first burst and end after the last one. In a gap of more than
/// three sample periods, samples are missing. Errors: InvalidArgument for no bursts, bursts or time stamps that do not
/// ascend, a duration that is not positive, or a time stamp that is not finite; NotFound if the quiet before the first
/// burst was not measured.
[[nodiscard]] Result<BurstFigures> burstFigures(std::span<const AccelerationSample> samples,
                                                std::span<const CommandedBurst> bursts);

}  // namespace tacto
