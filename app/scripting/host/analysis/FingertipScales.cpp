// Weights on a fingertip become the scales of its force and its taxels.
#include <cmath>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "app/scripting/host/analysis/GivenReadings.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonFields.h"

namespace tacto::host::analysis {

namespace {

/// What the references are known to, relative; NaN: not known, and neither is the uncertainty of what rests on it.
struct Tolerances {
    double weights = 0, gravity = kNaN, area = kNaN;
    [[nodiscard]] std::vector<double> ofForce() const { return {weights, gravity}; }
    [[nodiscard]] std::vector<double> ofPressure() const { return {weights, gravity, area}; }
};

/// One weight on the fingertip, and the way it was reached.
struct Weighed {
    WeightReading reading;
    SweepDirection direction;
};

Json evaluate(std::span<const CalibrationReading> readings, const std::vector<double>& tolerances,
              std::string_view name) {
    const auto found = fitSensorScale(readings, tolerances, name);
    if (found) return toJson(*found);
    Json none = {{"scale", nullptr}, {"reason", found.error().message}};
    if (found.error().code == ErrorCode::Device) none["follows"] = false;
    return none;
}

Json forceScale(const std::vector<Weighed>& weighed, const Tolerances& known) {
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
    auto out = evaluate(readings, known.ofForce(), "force");
    out["unit"] = symbolOf(*unit);
    return out;
}

Json taxelScale(const std::vector<Weighed>& weighed, std::size_t taxel, double area_cm2, const Tolerances& known) {
    const auto name = fmt::format("taxel {}", taxel + 1);
    Json found = {{"scale", nullptr}, {"reason", "the contact area is not known; no pressure to compare with"}};
    if (area_cm2 > 0) {
        constexpr double kSquareMetres = 1e-4;  // per cm²
        std::vector<CalibrationReading> readings;
        for (const auto& [reading, direction] : weighed) {
            readings.push_back({reading.reference_n / (area_cm2 * kSquareMetres), reading.taxels.at(taxel), direction});
        }
        found = evaluate(readings, known.ofPressure(), name);
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

Result<Json> sensorScale(ScriptSession&, const Arguments& arguments) {
    const Json& rows = arguments.list("readings");
    const auto name = arguments.text("options.name");
    const auto tolerance = arguments.number("options.tolerance_pct");
    const auto readings = readingsGiven("analysis.sensorScale", rows);
    if (!readings) return failure(readings);
    auto found = fitSensorScale(*readings, {tolerance / 100}, name);
    if (!found) return failure(found);
    return toJson(*found);
}

Result<Json> fingertipScales(ScriptSession& session, const Arguments& arguments) {
    const Json& rows = arguments.list("weighed");
    const auto known_pct = [&arguments](std::string_view name) {
        const double percent = arguments.number(name);
        return percent > 0 ? percent / 100 : kNaN;
    };
    const double area_cm2 = arguments.number("options.contact_area_cm2");
    const Tolerances known{arguments.number("options.tolerance_pct") / 100, known_pct("options.gravity_tolerance_pct"),
                           known_pct("options.contact_area_tolerance_pct")};

    bool own = true;
    std::vector<Weighed> weighed;
    for (const auto& row : rows) {
        const auto given = valueOr(row, "reading");
        auto reading = weightReadingFrom(given);
        if (!reading)
            return arguments.wrong("a weighed row", row, "{ reading: from bench.measureWeight(), direction }");
        const auto direction = directionGiven("analysis.fingertipScales", row);
        if (!direction) return failure(direction);
        weighed.push_back({std::move(*reading), *direction});
        own = own && session.own().noted(given);
        const auto& taxels = weighed.back().reading.taxels;
        if (taxels.size() != weighed.front().reading.taxels.size() ||
            (!taxels.empty() && !weighed.back().reading.taxelUnit))
            return arguments.wrong("a weighed row", given, "readings of one fingertip");
    }
    Json out = {{"force", forceScale(weighed, known)}, {"taxels", Json::array()}};
    const auto taxels = weighed.empty() ? 0 : weighed.front().reading.taxels.size();
    for (std::size_t k = 0; k < taxels; ++k) out["taxels"].push_back(taxelScale(weighed, k, area_cm2, known));
    if (own && !weighed.empty()) session.own().note(out);
    return out;
}

}  // namespace tacto::host::analysis
