// Computes the scales of a fingertip's force and taxels from weights on it.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"

namespace tacto::host::sensor_calibration {

namespace {

FingertipScale fitted(std::span<const CalibrationReading> readings, const std::vector<double>& tolerances,
                      std::string_view name) {
    auto found = fitSensorScale(readings, tolerances, name);
    if (found) return {.found = std::move(*found)};
    return {.reason = found.error().message, .follows = found.error().code != ErrorCode::Device};
}

FingertipScale forceScale(const std::vector<Weighed>& weighed, const WeighingTolerances& known) {
    if (weighed.empty()) return {.reason = "no weights were given; force was not evaluated"};
    const auto unit = weighed.front().reading.forceUnit;
    if (!unit) return {.reason = "this fingertip has no force sensor; force was not evaluated"};
    std::vector<CalibrationReading> readings;
    for (const auto& one : weighed) {
        if (std::isnan(one.reading.force))
            return {.reason = "a weight's force was not read; force was not evaluated", .asked = true};
        readings.push_back({one.reading.reference_n, one.reading.force, one.direction});
    }
    auto scale = fitted(readings, {known.weights, known.gravity}, "force");
    scale.unit = unit;
    return scale;
}

FingertipScale taxelScale(const std::vector<Weighed>& weighed, std::size_t taxel, double area_cm2,
                          const WeighingTolerances& known) {
    FingertipScale scale{.reason = "the contact area is not known; no pressure to compare with"};
    if (area_cm2 > 0) {
        constexpr double kSquareMetres = 1e-4;  // per cm²
        std::vector<CalibrationReading> readings;
        for (const auto& one : weighed) {
            readings.push_back(
                {one.reading.reference_n / (area_cm2 * kSquareMetres), one.reading.taxels.at(taxel), one.direction});
        }
        scale = fitted(readings, {known.weights, known.gravity, known.area}, fmt::format("taxel {}", taxel + 1));
    }
    scale.unit = weighed.front().reading.taxelUnit;
    return scale;
}

SensorLine lineOf(const SensorScale& scale) {
    return {scale.scale, scale.offset, std::isfinite(scale.scaleU) ? std::optional(scale.scaleU) : std::nullopt};
}

}  // namespace

FingertipScales fingertipScales(const std::vector<Weighed>& weighed, double area_cm2, const WeighingTolerances& known) {
    FingertipScales scales{.force = forceScale(weighed, known)};
    const auto taxels = weighed.empty() ? 0 : weighed.front().reading.taxels.size();
    for (std::size_t k = 0; k < taxels; ++k) scales.taxels.push_back(taxelScale(weighed, k, area_cm2, known));
    return scales;
}

Result<Json> useScales(ScriptSession& session, const FingertipScales& found) {
    SensorScales scales;
    scales.fingertip = session.bench().devices().sensor->identity().serial;
    const auto unitOf = [](const FingertipScale& scale, StreamUnit calibrated) {
        return scale.unit == calibrated ? calibrated : StreamUnit::Count;
    };
    if (found.force.found) {
        scales.forceUnit = unitOf(found.force, StreamUnit::Newton);
        scales.force = lineOf(*found.force.found);
    }
    // A dead taxel has no pressure: the mean would be over other taxels.
    if (std::ranges::all_of(found.taxels, [](const auto& taxel) { return taxel.found.has_value(); })) {
        for (const auto& taxel : found.taxels) {
            scales.taxelUnit = unitOf(taxel, StreamUnit::Pascal);
            scales.taxels.push_back(lineOf(*taxel.found));
        }
    }
    Profile profile = session.bench().profile();
    profile.roughness.sensor = scales;
    // References that were read with other scales are not valid with these.
    profile.roughness.calibrated = false;
    profile.roughness.uncertainty.reset();
    if (auto used = session.bench().setProfile(profile, RBefore::Measuring); !used) return failure(used);
    return Json{{"force", scales.force.has_value()}, {"taxels", !scales.taxels.empty()}};
}

}  // namespace tacto::host::sensor_calibration
