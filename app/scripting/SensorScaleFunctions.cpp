// Weights on a fingertip become the scales of its force and its taxels, and those are put into use.
#include <cmath>
#include <set>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/analysis/SensorCalibrationJson.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// What the references are known to; nothing: not known, and neither is the uncertainty of what rests on it.
struct Tolerances {
    double weights = 0;
    std::optional<double> gravity, area;
    [[nodiscard]] std::optional<double> ofForce() const {
        return gravity ? std::optional(std::hypot(weights, *gravity)) : std::nullopt;
    }
    [[nodiscard]] std::optional<double> ofPressure() const {
        const auto force = ofForce();
        return force && area ? std::optional(std::hypot(*force, *area)) : std::nullopt;
    }
};

/// One weight on the fingertip: a reading of bench.measureWeight() and the way it was reached.
struct Weighed {
    const Json* reading;
    SweepDirection direction;
};

Json evaluate(std::span<const CalibrationReading> readings, std::optional<double> tolerance, std::string_view name) {
    const auto found = fitSensorScale(readings, tolerance, name);
    if (!found) return {{"scale", nullptr}, {"reason", found.error().message}};
    return toJson(*found);
}

Json forceScale(const std::vector<Weighed>& weighed, const Tolerances& known) {
    const auto none = [](const char* reason) { return Json{{"scale", nullptr}, {"reason", reason}}; };
    if (weighed.empty()) return none("no weights were given; force was not evaluated");
    if (!weighed.front().reading->contains("force_unit"))
        return none("this fingertip has no force sensor; force was not evaluated");
    std::vector<CalibrationReading> readings;
    for (const auto& one : weighed) {
        if (!one.reading->at("force").is_number()) {
            auto missing = none("a weight's force was not read; force was not evaluated");
            missing["asked"] = true;
            return missing;
        }
        readings.push_back({one.reading->at("reference_n"), one.reading->at("force"), one.direction});
    }
    auto out = evaluate(readings, known.ofForce(), "force");
    out["unit"] = weighed.front().reading->at("force_unit");
    return out;
}

Json taxelScale(const std::vector<Weighed>& weighed, std::size_t taxel, double area_cm2, const Tolerances& known) {
    const auto name = fmt::format("taxel {}", taxel + 1);
    Json found = {{"scale", nullptr}, {"reason", "the contact area is not known; no pressure to compare with"}};
    if (area_cm2 > 0) {
        std::vector<CalibrationReading> readings;
        for (const auto& one : weighed) {
            const auto& read = one.reading->at("taxels").at(taxel);
            constexpr double kSquareMetres = 1e-4;  // per cm²
            readings.push_back({one.reading->at("reference_n").get<double>() / (area_cm2 * kSquareMetres),
                                read.is_number() ? read.get<double>() : std::nan(""), one.direction});
        }
        found = evaluate(readings, known.ofPressure(), name);
    }
    const auto of = [&found](const char* key) { return found.value(key, Json()); };
    return {{"taxel", taxel + 1},
            {"unit", weighed.front().reading->at("taxel_unit")},
            {"scale", of("scale")},
            {"scale_expanded_uncertainty", of("scale_expanded_uncertainty")},
            {"offset_pa", of("offset")},
            {"offset_expanded_uncertainty_pa", of("offset_expanded_uncertainty")},
            {"residual_max_pct_fs", of("residual_max_pct_fs")},
            {"reason", of("reason")}};
}

bool isReading(const Json& one) {
    return one.is_object() && one.value("reference_n", Json()).is_number() && one.contains("force") &&
           one.value("taxels", Json()).is_array();
}

Result<Json> fingertipScales(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.fingertipScales", list);
    auto rows = arguments.list(0, "weighed");
    if (!rows) return failure(rows);
    auto options = arguments.options(
        1, {"tolerance_pct", "gravity_tolerance_pct", "contact_area_cm2", "contact_area_tolerance_pct"});
    if (!options) return failure(options);
    double percent[3] = {}, area_cm2 = 0;
    for (const auto& [key, most, target] :
         {std::tuple("tolerance_pct", 50.0, &percent[0]), std::tuple("gravity_tolerance_pct", 50.0, &percent[1]),
          std::tuple("contact_area_tolerance_pct", 90.0, &percent[2]),
          std::tuple("contact_area_cm2", 100.0, &area_cm2)}) {
        auto value = arguments.number(*options, key, 0, {0, most});
        if (!value) return failure(value);
        *target = *value;
    }
    Tolerances known{percent[0] / 100, std::nullopt, std::nullopt};
    if (percent[1] > 0) known.gravity = percent[1] / 100;
    if (percent[2] > 0) known.area = percent[2] / 100;

    bool own = true;
    std::vector<Weighed> weighed;
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.contains("reading") || !isReading(row["reading"]))
            return arguments.wrong("a weighed row", row, "{ reading: from bench.measureWeight(), direction }");
        const auto& reading = row["reading"];
        const Json direction = row.value("direction", Json(""));
        weighed.push_back({&reading, direction == "up"     ? SweepDirection::Up
                                     : direction == "down" ? SweepDirection::Down
                                                           : SweepDirection::None});
        own = own && session.own().noted(reading);
        if (reading["taxels"].size() != weighed.front().reading->at("taxels").size() ||
            (!reading["taxels"].empty() && !reading.contains("taxel_unit")))
            return arguments.wrong("a weighed row", reading, "readings of one fingertip");
    }
    Json out = {{"force", forceScale(weighed, known)}, {"taxels", Json::array()}};
    const auto taxels = weighed.empty() ? 0 : weighed.front().reading->at("taxels").size();
    for (std::size_t k = 0; k < taxels; ++k) out["taxels"].push_back(taxelScale(weighed, k, area_cm2, known));
    if (own && !weighed.empty()) session.own().note(out);
    return out;
}

std::optional<double> numberOf(const Json& value) {
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

Result<Json> useFingertipScales(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.useFingertipScales", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    // What turns readings into pressure, and so into trains, is measured and not made up (hazard H7).
    if (!session.own().noted(**found)) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.useFingertipScales: these scales do not come from this run's own weights; what "
                    "analysis.fingertipScales() returned is expected, unchanged");
    }
    const auto& sensor = session.bench().devices().sensor;
    if (!sensor) return fail(ErrorCode::Unsupported, "bench.useFingertipScales: no sensor is connected");
    SensorScales scales;
    scales.fingertip = sensor->identity().serial;
    const auto unitOf = [](const Json& row, StreamUnit calibrated) {
        return row["unit"] == symbolOf(calibrated) ? calibrated : StreamUnit::Count;
    };
    const auto& force = (**found)["force"];
    if (force["scale"].is_number()) {
        scales.forceUnit = unitOf(force, StreamUnit::Newton);
        scales.force = SensorLine{force["scale"], force["offset"], numberOf(force["scale_expanded_uncertainty"])};
    }
    const auto& taxels = (**found)["taxels"];
    const bool all =
        std::all_of(taxels.begin(), taxels.end(), [](const Json& row) { return row["scale"].is_number(); });
    for (const auto& row : taxels) {
        if (!all) break;  // one that is dead has no pressure, and a mean over the others would be of others
        scales.taxelUnit = unitOf(row, StreamUnit::Pascal);
        scales.taxels.push_back({row["scale"], row["offset_pa"], numberOf(row["scale_expanded_uncertainty"])});
    }
    Profile profile = session.bench().profile();
    profile.roughness.sensor = scales;
    // References that were read under other scales do not hold under these.
    profile.roughness.calibrated = false;
    profile.roughness.uncertainty.reset();
    if (auto used = session.bench().setProfile(profile, RBefore::Measuring); !used) return failure(used);
    return Json{{"force", scales.force.has_value()}, {"taxels", !scales.taxels.empty()}};
}

}  // namespace

std::vector<HostFunction> sensorScaleFunctions() {
    return {
        {"analysis",
         "fingertipScales",
         HostKind::Function,
         {{"weighed", "list", "", "objects { reading: from bench.measureWeight(), direction: up or down }"},
          {"options.tolerance_pct", "number", "%", "half-width that all weights share; 0 where left out", true},
          {"options.gravity_tolerance_pct", "number", "%", "half-width of local gravity; 0: not known", true},
          {"options.contact_area_cm2", "number", "cm2", "area under a weight; 0: not known", true},
          {"options.contact_area_tolerance_pct", "number", "%", "half-width of the area; 0: not known", true}},
         "What one unit of force and of each taxel stands for: force against the weights, taxels against their "
         "pressure over the contact area.",
         "{ force, taxels: list }: force as analysis.sensorScale() with unit, taxels { taxel, unit, scale, offset_pa, "
         "… }; scale is null with a reason where there is none, and an uncertainty is null where a tolerance that it "
         "rests on is not known.",
         "Throws for rows that are not readings of one fingertip.",
         fingertipScales},
        {"bench",
         "useFingertipScales",
         HostKind::Function,
         {{"found", "object", "", "from analysis.fingertipScales()"}},
         "Turns force and taxels into N and Pa by these scales for the rest of the run; R is uncalibrated until "
         "references were read under them. record.sensorProfile() keeps them.",
         "{ force, taxels }: whether each is scaled now.",
         "Throws for scales that this run did not measure itself.",
         useFingertipScales},
    };
}

}  // namespace tacto
