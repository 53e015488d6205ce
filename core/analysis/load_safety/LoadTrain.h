// LoadTrain.h - the figures that one capture gives for one train into a load, and statistics over the trains of a load.
// Private to core/analysis.
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

/// The figures of one train from its own capture, in SI units; NaN if not measured. A single pulse has no rate.
struct TrainFigures {
    double onset_s = kNaN, width_s = kNaN, rate_hz = kNaN, plateau_v = kNaN, end_v = kNaN, end_a = kNaN;
    double peak_v = kNaN, peak_a = kNaN, step_v = 0, step_a = 0;
    double magnitude_v = 0, magnitude_a = 0;
    double squares_v = kNaN, squares_a = kNaN, net_C = kNaN, phase_C = kNaN, energy_J = kNaN;
    double line_v = 0;  ///< how far the voltage was extrapolated from the part that was read
    double impedance = kNaN, delivered = kNaN;
    double noise_v = 0, noise_a = 0;
    double endSamples = 1;
    bool biphasic = false;
};

/// The channel that the source drives.
[[nodiscard]] std::string_view drivenBy(const ExpectedTrain& expected);

/// Finds the pulses of a train in the driven channel. Returns nothing, with a warning, unless all pulses are measured.
[[nodiscard]] std::optional<ChannelMeasurement> pulsesOf(const Capture& capture, const ExpectedTrain& expected,
                                                         std::vector<std::string>& warnings);

/// Reads the values at the ends of the leading phases. `current` is null if the current cannot be read.
void readEnds(const LoadTrace& voltage, const LoadTrace* current, const ChannelMeasurement& pulses, Drive drive,
              TrainFigures& out);

/// Returns nothing, with a warning, if the voltage cannot be read. Without a current channel the current figures are
/// NaN. `programmed`: the amplitude to be delivered.
[[nodiscard]] std::optional<TrainFigures> readTrain(const Capture& capture, const ExpectedTrain& expected,
                                                    double programmed, std::vector<std::string>& warnings);

using LoadTrains = std::vector<TrainFigures>;
[[nodiscard]] Statistics statisticsOver(const LoadTrains& trains, double TrainFigures::*member);
[[nodiscard]] double meanOver(const LoadTrains& trains, double TrainFigures::*member);
/// Returns NaN if any value is NaN, because the unmeasured train may have had the largest value.
[[nodiscard]] double largestOf(const LoadTrains& trains, double TrainFigures::*member);

}  // namespace tacto
