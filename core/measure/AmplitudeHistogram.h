// AmplitudeHistogram.h - how long a signal spends at each level, and the levels at which it stays: the modes.
//
// 200 bins cover the range of the record. The two lowest and two highest samples are ignored, so that a glitch does not
// widen the range. Private to core/measure.
//
// Thread-safety: immutable after construction.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/SampleBlocks.h"

namespace tacto {

struct Mode {
    std::size_t bin = 0;
    double weight = 0;  ///< samples within the smoothing window
    double level = 0;   ///< mean of these samples, in their unit
};

/// Keeps a count and a sum for each bin, so that a level is a mean of samples and not the centre of a bin.
class AmplitudeHistogram {
public:
    /// `noise`: standard deviation; it sets how far apart two modes must be. Neighbouring codes of the converter, `lsb`
    /// apart (0 = unknown), are one mode. The range must not be empty.
    AmplitudeHistogram(const SampleBlocks& blocks, double noise, double lsb);

    /// Returns the local maxima of the smoothed histogram that valleys separate, in ascending order.
    [[nodiscard]] std::vector<Mode> modes() const;
    /// Integrates the samples above (sign +1) or below (-1) the mode's window, from its level; in unit × samples.
    [[nodiscard]] double chargeBeside(const Mode& mode, int sign) const;
    /// Returns the share of samples above `level`, to the accuracy of one bin.
    [[nodiscard]] double shareAbove(double level) const;

private:
    static constexpr std::size_t kBins = 200;

    void fill(std::span<const float> samples);
    [[nodiscard]] Mode modeAt(std::size_t bin) const;

    std::array<double, kBins> count_{};
    std::array<double, kBins> sum_{};
    double low_ = 0;
    double width_ = 0;
    std::size_t halfWindow_ = 2;
    std::size_t noiseReach_ = 2;  ///< the noise of a mode stays within this many bins of the mode
};

}  // namespace tacto
