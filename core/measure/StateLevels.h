// StateLevels.h - the levels at which a signal rests (IEEE Std 181): the modes of its amplitude histogram.
//
// Found for pulses that fill a hundred-thousandth of the record as well as for a square wave. Three states with the
// baseline between them are biphasic pulses, told from ringing by the charge on either side: a biphasic pulse returns
// at least a fifth of what it gave. Neighbouring codes of the converter are one state, and states are at least two and
// a half of its steps apart. Noise, a ramp or a sine never rests, and so has no two states.
#pragma once

#include <limits>
#include <span>
#include <string>

namespace tacto {

class SampleBlocks;

enum class StateCount { None = 0, Two = 2, Three = 3 };

/// Levels are in the channel's unit, a bare double because the unit is data (V, A, logic).
struct StateLevels {
    StateCount count = StateCount::None;
    double baseline = std::numeric_limits<double>::quiet_NaN();  ///< where the signal rests between pulses
    double high = std::numeric_limits<double>::quiet_NaN();      ///< upper state; the baseline itself if pulses go down
    double low = std::numeric_limits<double>::quiet_NaN();       ///< lower state; the baseline itself if pulses go up
    double noise = 0;                                            ///< standard deviation about the baseline
    std::string why;                                             ///< count None: a clause saying why, for a warning
};

/// `lsb`: the channel's resolution, 0 = unknown. `logic`: samples that are all 0 or 1 have these as states.
/// Two states: the baseline is the state with nine tenths of the samples; else the one near zero (within a tenth of
/// the difference) if the other is not; else the lower. NaN samples are left out.
[[nodiscard]] StateLevels findStateLevels(std::span<const float> samples, double lsb, bool logic);
/// Finds the levels of a record with known extremes.
[[nodiscard]] StateLevels findStateLevels(const SampleBlocks& blocks, double lsb, bool logic);

/// Standard deviation of the noise from the median step between neighbours (4096 of them): edges are too few to move
/// it. At least lsb/√12. Noise that is slower than the samples are apart looks smaller than it is.
[[nodiscard]] double neighbourNoise(std::span<const float> samples, double lsb);

}  // namespace tacto
