// AmplitudeHistogram.h - how long a signal spends at each level, and the levels at which it stays: the modes.
//
// 200 bins over the record's range without its two outermost samples on either side: a glitch must not stretch it.
// Private to core/measure.
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
    double level = 0;   ///< their mean, in the samples' unit
};

/// Counts and sums per bin, so that a level is a mean of samples and not a bin's centre.
class AmplitudeHistogram {
public:
    /// `noise`: standard deviation; sets how far apart two modes must be. Neighbouring codes, `lsb` apart (0 =
    /// unknown), are one mode. The range must not be empty.
    AmplitudeHistogram(const SampleBlocks& blocks, double noise, double lsb);

    /// Local maxima of the smoothed histogram that are separated by valleys, ascending.
    [[nodiscard]] std::vector<Mode> modes() const;
    /// ∫ of what lies above (sign +1) or below (-1) the mode's window, relative to its level; in unit times samples.
    [[nodiscard]] double chargeBeside(const Mode& mode, int sign) const;
    /// Share of samples above `level`, to a bin's width.
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
    std::size_t noiseReach_ = 2;  ///< no noise of a mode lies more than this many bins from it
};

}  // namespace tacto
