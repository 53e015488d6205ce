// Computes the scales of a fingertip's force and taxels from weights on it.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"

namespace tacto::host::sensor_calibration {

namespace {

std::optional<double> numberOf(const Json& value) {
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

Json evaluate(std::span<const CalibrationReading> readings, const std::vector<double>& tolerances,
              std::string_view name) {
    const auto found = fitSensorScale(readings, tolerances, name);
    if (found) return toJson(*found);
    Json none = {{"scale", nullptr}, {"reason", found.error().message}};
    if (found.error().code == ErrorCode::Device) none["follows"] = false;
    return none;
}

Json forceScale(const std::vector<Weighed>& weighed, const WeighingTolerances& known) {
    const auto none = [](const char* reason) { return Json{{"scale", nullptr}, {"reason", reason}}; };
    if (weighed.empty()) return none("no weights were given; force was not evaluated");
    const auto unit = weighed.front().reading.forceUnit;
    if (!unit) return none("this fingertip has no force sensor; force was not evaluated");
    std::vector<CalibrationReading> readings;
    for (const auto& one : weighed) {
        if (std::isnan(one.reading.force)) {
            auto missing = none("a weight's force was not read; force was not evaluated");
            missing["asked"] = true;
            return missing;
        }
        readings.push_back({one.reading.reference_n, one.reading.force, one.direction});
    }
    auto out = evaluate(readings, {known.weights, known.gravity}, "force");
    out["unit"] = symbolOf(*unit);
    return out;
}

Json taxelScale(const std::vector<Weighed>& weighed, std::size_t taxel, double area_cm2,
                const WeighingTolerances& known) {
    const auto name = fmt::format("taxel {}", taxel + 1);
    Json found = {{"scale", nullptr}, {"reason", "the contact area is not known; no pressure to compare with"}};
    if (area_cm2 > 0) {
        constexpr double kSquareMetres = 1e-4;  // per cm²
        std::vector<CalibrationReading> readings;
        for (const auto& [reading, direction] : weighed) {
            readings.push_back({reading.reference_n / (area_cm2 * kSquareMetres), reading.taxels.at(taxel), direction});
        }
        found = evaluate(readings, {known.weights, known.gravity, known.area}, name);
    }
    const auto of = [&found](const char* key) { return found.value(key, Json()); };
    Json out = {{"taxel", taxel + 1},
                {"unit", symbolOf(*weighed.front().reading.taxelUnit)},
                {"scale", of("scale")},
                {"scale_expanded_uncertainty", of("scale_expanded_uncertainty")},
                {"offset_pa", of("offset")},
                {"offset_expanded_uncertainty_pa", of("offset_expanded_uncertainty")},
                {"residual_max_pct_fs", of("residual_max_pct_fs")},
                {"reason", of("reason")}};
    if (found.contains("follows")) out["follows"] = found["follows"];
    return out;
}

}  // namespace

Json fingertipScales(const std::vector<Weighed>& weighed, double area_cm2, const WeighingTolerances& known) {
    Json out = {{"force", forceScale(weighed, known)}, {"taxels", Json::array()}};
    const auto taxels = weighed.empty() ? 0 : weighed.front().reading.taxels.size();
    for (std::size_t k = 0; k < taxels; ++k) out["taxels"].push_back(taxelScale(weighed, k, area_cm2, known));
    return out;
}

Result<Json> useScales(ScriptSession& session, const Json& found) {
    SensorScales scales;
    scales.fingertip = session.bench().devices().sensor->identity().serial;
    const auto streamUnitOf = [](const Json& row, StreamUnit calibrated) {
        return row["unit"] == symbolOf(calibrated) ? calibrated : StreamUnit::Count;
    };
    const auto& force = found.at("force");
    if (force["scale"].is_number()) {
        scales.forceUnit = streamUnitOf(force, StreamUnit::Newton);
        scales.force = SensorLine{force["scale"], force["offset"], numberOf(force["scale_expanded_uncertainty"])};
    }
    const auto& taxels = found.at("taxels");
    const bool all =
        std::all_of(taxels.begin(), taxels.end(), [](const Json& row) { return row["scale"].is_number(); });
    for (const auto& row : taxels) {
        if (!all) break;  // a dead taxel has no pressure: the mean would be over other taxels
        scales.taxelUnit = streamUnitOf(row, StreamUnit::Pascal);
        scales.taxels.push_back({row["scale"], row["offset_pa"], numberOf(row["scale_expanded_uncertainty"])});
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
