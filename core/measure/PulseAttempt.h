// PulseAttempt.h - one way of viewing a channel, with the pulses found in that view and the signal around them. Private
// to core/measure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/measure/PulseMeasurement.h"
#include "core/measure/SampleBlocks.h"
#include "core/measure/StateLevels.h"

namespace tacto {

struct PulseAttempt {
    StateLevels levels;
    std::vector<PulseMeasurement> pulses;
    std::size_t mean = 1;
    std::size_t meanOfSecond = 1;
    double widest_s = 0;         // width of the widest phase
    double secondStandsOut = 0;  // second state over the noise, in its own view, if there are three states
    double unrest = 0;           // as in SignalQuality
    double levelAfter = 0;       // as in SignalQuality
    double levelBefore = 0;
    double beside = 0;      ///< level of the signal just outside its pulses, from the baseline
    double mostBeside = 0;  ///< the largest such level of the pulses examined

    [[nodiscard]] bool hasStates() const noexcept { return levels.count != StateCount::None; }
    [[nodiscard]] bool mostlyMeasured() const {
        const auto n = std::count_if(pulses.begin(), pulses.end(), [](const auto& p) { return p.flags.measured(); });
        return n > 0 && 2 * static_cast<std::size_t>(n) >= pulses.size();
    }
    [[nodiscard]] bool mostlyPaired() const {
        const auto n = std::count_if(pulses.begin(), pulses.end(),
                                     [](const auto& p) { return p.second.has_value() || !p.flags.measured(); });
        return n > 0 && 2 * static_cast<std::size_t>(n) >= pulses.size();
    }
};

/// Returns the distance from the baseline to a state; 0 if there is no such state.
[[nodiscard]] double distanceOf(double state, double baseline);
/// Returns the distance from the baseline to the state that is further away.
[[nodiscard]] double heightOf(const StateLevels& levels);

/// Returns how far the baseline moves in excess of its noise: two thirds of the samples around it lie within this
/// distance. 0 for noise alone, or if the movement is below 1/50 of the pulses.
[[nodiscard]] double unrestOf(const SampleView& view, const StateLevels& levels, double noise);

/// Returns false if edges fill the pulses (a sine, a triangle): such a signal has no states, despite its histogram.
[[nodiscard]] bool restsOnPlateaus(const std::vector<PulseMeasurement>& pulses);

/// Returns a wave of the baseline that was measured as a pulse: low and long compared with the others, and without a
/// plateau. Null if there is none.
[[nodiscard]] const PhaseMeasurement* slowWave(const PulseAttempt& found);

struct AfterPulses {
    double difference = 0;  // the silence after minus the silence before
    double before = 0;
};

/// Compares the level just after pulses, where a second phase may begin, with the level just before them. Returns the
/// difference if it is opposite to the pulses and exceeds the noise (five standard deviations of the means).
/// `within_s`: the latest start of a second phase.
[[nodiscard]] std::optional<AfterPulses> levelAfter(const SampleView& view, const PulseAttempt& found, double within_s);

/// Measures how far the signal lies from the baseline just outside its pulses, beyond the noise: on the larger side,
/// the RMS over all pulses and the largest value. `noise`: standard deviation of a sample.
void lookBeside(const SampleView& view, PulseAttempt& found, double noise);

}  // namespace tacto
