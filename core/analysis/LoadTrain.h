// LoadTrain.h - what one capture shows of one train into a load. Private to core/analysis.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/LoadReading.h"
#include "core/analysis/LoadTrace.h"
#include "core/base/NaN.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

/// Of one train, from its own capture. SI units; NaN where not measured.
struct TrainFigures {
    double onset_s = kNaN, width_s = kNaN, plateau_v = kNaN, end_v = kNaN, end_a = kNaN;
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

/// What the ends of its leading phases show; `current` is null where it cannot be read.
void readEnds(const LoadTrace& voltage, const LoadTrace* current, const ChannelMeasurement& pulses, Drive drive,
              TrainFigures& out);

/// Nothing, with a warning, where the voltage cannot be read; without the current its figures are NaN. `told`: the
/// amplitude that was to be delivered.
[[nodiscard]] std::optional<TrainFigures> readTrain(const Capture& capture, const ExpectedTrain& expected, double told,
                                                    std::vector<std::string>& warnings);

}  // namespace tacto
