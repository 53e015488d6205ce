// StateLevels.h - finds the levels at which a signal rests (IEEE Std 181): the modes of its amplitude histogram.
//
// This works for pulses that fill a hundred-thousandth of the record and for a square wave. Three states with the
// baseline in the middle are biphasic pulses or ringing. They are pulses if the charge on one side is at least a fifth
// of that on the other. Neighbouring codes of the converter form one state; states are at least two and a half steps
// apart. Noise, a ramp or a sine never rests, and so does not have two states.
#pragma once

#include <limits>
#include <span>
#include <string>

namespace tacto {

class SampleBlocks;

enum class StateCount { None = 0, Two = 2, Three = 3 };

/// Levels are in the channel's unit, bare doubles because the unit is data (V, A, logic).
struct StateLevels {
    StateCount count = StateCount::None;
    double baseline = std::numeric_limits<double>::quiet_NaN();  ///< level at which the signal rests between pulses
    double high = std::numeric_limits<double>::quiet_NaN();      ///< upper state; the baseline itself if pulses go down
    double low = std::numeric_limits<double>::quiet_NaN();       ///< lower state; the baseline itself if pulses go up
    double noise = 0;                                            ///< standard deviation about the baseline
    std::string why;                                             ///< if count is None: a clause with the reason
};

/// `lsb`: the channel's resolution, 0 = unknown. `logic`: if all samples are 0 or 1, these are the states. With two
/// states, the baseline is the state with nine tenths of the samples; else the only state near zero (within a tenth of
/// the difference); else the lower state. NaN samples are ignored.
[[nodiscard]] StateLevels findStateLevels(std::span<const float> samples, double lsb, bool logic);
/// Finds the levels of a record from blocks with known extremes.
[[nodiscard]] StateLevels findStateLevels(const SampleBlocks& blocks, double lsb, bool logic);

/// Returns the standard deviation of the noise, from the median difference of neighbours (4096 of them); edges are too
/// few to affect it. At least lsb/√12. Noise that varies slowly from sample to sample is underestimated.
[[nodiscard]] double neighbourNoise(std::span<const float> samples, double lsb);

}  // namespace tacto
