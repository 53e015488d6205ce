// PulseAttempt.h - one way to look at a channel, the pulses that it shows, and how the signal lies about them. Private
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
    double widest_s = 0;         // phase
    double secondStandsOut = 0;  // how far it stands out in its own view, where there are three states
    double unrest = 0;           // see SignalQuality
    double levelAfter = 0;       // as SignalQuality::levelAfter
    double levelBefore = 0;
    double beside = 0;      ///< level of the signal just beside its pulses, from the baseline
    double mostBeside = 0;  ///< the largest of all pulses that were looked at

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

/// The distance from the baseline to a state; 0 where there is none.
[[nodiscard]] double distanceOf(double state, double baseline);
/// The distance from the baseline to the state that is further away.
[[nodiscard]] double heightOf(const StateLevels& levels);

/// How far the baseline moves by more than its noise: two thirds of the samples around it are within this. 0 if it is
/// only noise, or less than a fiftieth of the pulses.
[[nodiscard]] double unrestOf(const SampleView& view, const StateLevels& levels, double noise);

/// A signal whose edges fill its pulses (a sine, a triangle) has no states, whatever its histogram says.
[[nodiscard]] bool restsOnPlateaus(const std::vector<PulseMeasurement>& pulses);

/// A wave of the baseline that is measured as a pulse: low and long beside the others, and without a plateau. Null
/// without one.
[[nodiscard]] const PhaseMeasurement* slowWave(const PulseAttempt& found);

struct AfterPulses {
    double difference = 0;  // the silence after less the one before
    double before = 0;
};

/// The level after pulses, as far as a second phase may begin, against that just before them, where the difference
/// goes against the pulses and exceeds the noise: five standard deviations of the means. `within_s`: how soon a second
/// phase begins at most.
[[nodiscard]] std::optional<AfterPulses> levelAfter(const SampleView& view, const PulseAttempt& found, double within_s);

/// How far the signal lies from the baseline just beside its pulses, beyond the noise: on the larger side, the RMS over
/// pulses and the largest. `noise`: a sample's, standard deviation.
void lookBeside(const SampleView& view, PulseAttempt& found, double noise);

}  // namespace tacto
