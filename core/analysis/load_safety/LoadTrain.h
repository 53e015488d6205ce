// LoadTrain.h - what one capture shows of one train into a load, and what the trains of a load have in common. Private
// to core/analysis.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/load_safety/LoadReading.h"
#include "core/analysis/load_safety/LoadTrace.h"
#include "core/base/Statistics.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// The figures of one train, from its own capture. SI units; NaN where not measured. A single pulse has no rate.
struct TrainFigures {
    double onset_s = kNaN, width_s = kNaN, rate_hz = kNaN, plateau_v = kNaN, end_v = kNaN, end_a = kNaN;
    double peak_v = kNaN, peak_a = kNaN, step_v = 0, step_a = 0;
    double magnitude_v = 0, magnitude_a = 0;
    double squares_v = kNaN, squares_a = kNaN, net_C = kNaN, phase_C = kNaN, energy_J = kNaN;
    double line_v = 0;  ///< how far the voltage was followed from where it was read
    double impedance = kNaN, delivered = kNaN;
    double noise_v = 0, noise_a = 0;
    double endSamples = 1;
    bool biphasic = false;
};

/// The channel that the source drives.
[[nodiscard]] std::string_view drivenBy(const ExpectedTrain& expected);

/// The pulses of a train by what is driven; nothing, with a warning, unless all of them are measured.
[[nodiscard]] std::optional<ChannelMeasurement> pulsesOf(const Capture& capture, const ExpectedTrain& expected,
                                                         std::vector<std::string>& warnings);

/// The values at the ends of its leading phases; `current` is null where it cannot be read.
void readEnds(const LoadTrace& voltage, const LoadTrace* current, const ChannelMeasurement& pulses, Drive drive,
              TrainFigures& out);

/// Nothing, with a warning, where the voltage cannot be read; without a current, its figures are NaN. `programmed`: the
/// amplitude that was to be delivered.
[[nodiscard]] std::optional<TrainFigures> readTrain(const Capture& capture, const ExpectedTrain& expected,
                                                    double programmed, std::vector<std::string>& warnings);

using LoadTrains = std::vector<TrainFigures>;
[[nodiscard]] Statistics statisticsOver(const LoadTrains& trains, double TrainFigures::*member);
[[nodiscard]] double meanOver(const LoadTrains& trains, double TrainFigures::*member);
/// NaN when any is: what one train did not show may have been the largest.
[[nodiscard]] double largestOf(const LoadTrains& trains, double TrainFigures::*member);

}  // namespace tacto
