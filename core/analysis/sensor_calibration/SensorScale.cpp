#include "core/analysis/sensor_calibration/SensorScale.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/UncertaintyBudget.h"

namespace tacto {

namespace {

/// U of what scatters by `u` and carries the tolerances that all references share, times `scale`.
double expandedOf(double u, double freedom, const std::vector<double>& tolerances, double scale) {
    if (std::isnan(u)) return u;
    std::vector<Contribution> rows{{"repeatability", Distribution::Student, u, 1, 1, std::max(1.0, freedom)}};
    for (const double tolerance : tolerances)
        rows.push_back({"references", Distribution::Rectangular, tolerance, std::sqrt(3.0), scale});
    // A fingertip has many taxels; 20 000 draws know U to a third of a percent.
    const auto budget = combine(std::move(rows), {.draws = 20'000});
    return budget ? budget->expanded : std::nan("");
}

}  // namespace

Result<SensorScale> fitSensorScale(std::span<const CalibrationReading> readings, const std::vector<double>& tolerances,
                                   std::string_view what) {
    for (const double tolerance : tolerances) {
        if (std::isnan(tolerance) || (tolerance >= 0 && tolerance < 1)) continue;
        return fail(ErrorCode::InvalidArgument, "{}: a tolerance of the references of {}; 0 to below 1 is expected",
                    what, tolerance);
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
    out.scaleU = expandedOf(std::abs(out.scale) * se / std::abs(gain), freedom, tolerances, out.scale);
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
    out.offsetU = expandedOf(std::sqrt(std::max(0.0, variance)) / std::abs(gain), freedom, tolerances, out.offset);
    out.fit = *std::move(fit);
    return out;
}

}  // namespace tacto
