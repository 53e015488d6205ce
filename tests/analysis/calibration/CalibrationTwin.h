// CalibrationTwin.h - simulates a device of known gain, offset, scatter and hysteresis, read by an instrument with
// errors drawn for each run from the distributions in a budget.
//
// Thread-safety: used only by the thread of the test.
#pragma once

#include <cmath>
#include <vector>

#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/base/Random.h"

namespace tacto::test {

struct CalibrationTwin {
    double gain = 1.013;
    double offset = 0.15;
    double jitter = 0.03;       ///< standard deviation of repeats at the largest command
    bool jitterScales = false;  ///< jitter proportional to the command
    double hysteresis = 0.08;   ///< reading going down minus reading going up
    double low = 10;
    double high = 40;
    std::size_t levels = 11;
    std::size_t repeats = 5;
    InstrumentErrors instrument{.gainTolerance = 0, .resolution = 0};

    [[nodiscard]] double levelAt(std::size_t k) const {
        return low + (high - low) * static_cast<double>(k) / static_cast<double>(levels - 1);
    }
    /// Returns the delivered value, the mean of both directions.
    [[nodiscard]] double truth(double commanded) const { return gain * commanded + offset; }

    [[nodiscard]] std::vector<CalibrationReading> run(std::uint64_t seed) const {
        Random random(seed, "calibration twin");
        const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
        const double gainError = within(instrument.gainTolerance);
        const double offsetError = within(instrument.offsetTolerance);
        std::vector<double> resolutionError(levels);
        for (auto& error : resolutionError) error = within(instrument.resolution / 2);
        std::vector<CalibrationReading> readings;
        for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
            for (const auto direction : {SweepDirection::Up, SweepDirection::Down}) {
                for (std::size_t step = 0; step < levels; ++step) {
                    const std::size_t k = direction == SweepDirection::Up ? step : levels - 1 - step;
                    const double command = levelAt(k);
                    const double s = jitterScales ? jitter * command / high : jitter;
                    const double delivered = truth(command) + s * random.normal() +
                                             (direction == SweepDirection::Up ? -0.5 : 0.5) * hysteresis;
                    readings.push_back(
                        {command, delivered * (1 + gainError) + offsetError + resolutionError[k], direction});
                }
            }
        }
        return readings;
    }
};

}  // namespace tacto::test
