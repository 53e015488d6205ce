#include "core/analysis/sensor_calibration/SensorScale.h"

#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"

namespace tacto {

Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings,
                                   std::optional<double> referenceTolerance, std::string_view what) {
    if (referenceTolerance && (!(*referenceTolerance >= 0) || !(*referenceTolerance < 1))) {
        return fail(ErrorCode::InvalidArgument, "{}: a tolerance of the references of {}; 0 to below 1 is expected",
                    what, *referenceTolerance);
    }
    auto fit = fitCalibration(readings);
    if (!fit) return failure(fit);
    SensorScale out;
    const double gain = fit->gain, freedom = fit->degreesOfFreedom;
    const double se = fit->gainStandardError;
    const double k = studentQuantile(0.975, freedom);
    if (!std::isfinite(gain) || gain == 0 || std::abs(gain) <= k * se) {
        return fail(ErrorCode::Device,
                    "{} does not follow the references: its slope is {:.3g} ± {:.2g}; one that differs from 0 is "
                    "expected",
                    what, gain, k * se);
    }
    out.scale = 1 / gain;
    out.offset = -fit->offset / gain;
    const double typeA = se / std::abs(gain);
    const double typeB = referenceTolerance ? *referenceTolerance / std::sqrt(3.0) : std::nan("");
    const double combined = std::hypot(typeA, typeB);
    if (!referenceTolerance) {
        out.scaleU = std::numeric_limits<double>::quiet_NaN();
    } else if (typeA > 0) {
        const double effective = freedom * std::pow(combined / typeA, 4);
        out.scaleU = studentQuantile(0.975, effective) * combined * std::abs(out.scale);
    } else if (typeA == 0) {
        out.scaleU = studentQuantile(0.975, std::numeric_limits<double>::infinity()) * combined * std::abs(out.scale);
    }
    // offset / gain: the two are correlated, cov = - (mean of the references) · var(gain) for an unweighted line.
    double sum = 0;
    std::size_t n = 0;
    for (const auto& reading : readings) {
        if (std::isnan(reading.measured)) continue;
        sum += reading.commanded;
        ++n;
    }
    const double mean = sum / static_cast<double>(n), ratio = fit->offset / gain;
    const double variance =
        fit->offsetStandardError * fit->offsetStandardError + ratio * ratio * se * se + 2 * ratio * mean * se * se;
    const double ownU = k * std::sqrt(std::max(0.0, variance)) / std::abs(gain);
    out.offsetU =
        std::hypot(ownU, studentQuantile(0.975, std::numeric_limits<double>::infinity()) * typeB * out.offset);
    out.fit = *std::move(fit);
    return out;
}

}  // namespace tacto
