// What the calibration of a fingertip begins and ends with.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/calibration/CalibrationObject.h"
#include "app/scripting/host/report/Cells.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/JsonFields.h"
#include "core/base/QuantityText.h"

namespace tacto::host::calibration {

namespace {

using report::digitsOf;

constexpr std::size_t kMaxWeighings = 10'000;  // of one direction
constexpr double kStandsOut = 5;  // standard deviations at rest

std::string toldApart(const Json& results) {
    const Json& surfaces = results.at("surfaces");
    const Json& distance = results.at("d_prime").at("R");
    // What one repeat cannot tell is not known, and is not 0.
    return fmt::format("{} and {} are told apart: d′ of R is {} (95 %: {} to {}), at least 1 is wanted",
                       surfaces.at(0).at("name").get<std::string>(), surfaces.at(1).at("name").get<std::string>(),
                       digitsOf(numberOr(distance, "value"), 3), digitsOf(numberOr(distance, "low"), 3),
                       digitsOf(numberOr(distance, "high"), 3));
}

std::string whyNot(const Json& check, double measured, double expanded) {
    const auto unit = textOr(check, "unit"), verdict = textOr(check, "verdict");
    const double newtons = numberOr(check, "reference_n");
    if (std::isnan(measured))
        return fmt::format(
            "the known-reference check was not evaluated: nothing was read under {} N; nothing was calibrated",
            digitsOf(newtons, 4));
    const bool inNewtons = unit == symbolOf(StreamUnit::Newton);
    if (inNewtons && std::isnan(expanded))
        return fmt::format(
            "the known-reference check was not evaluated: {} N was read under {} N, and how well the "
            "weight, local gravity or the reading is known was not stated; nothing was calibrated",
            digitsOf(measured, 4), digitsOf(newtons, 4));
    return fmt::format(
        "the known-reference check {}: {} was read under {} N{}; nothing was calibrated",
        verdict == "fail" ? "failed" : "is indeterminate",
        inNewtons ? measuredText(measured, expanded, unit) : digitsOf(measured, 4) + " " + unit, digitsOf(newtons, 4),
        inNewtons ? fmt::format("; {:.4g} % are allowed, uncertainty included", numberOr(check, "allowed_pct"))
                  : std::string());
}

}  // namespace

Result<Json> weighings(ScriptSession&, const Arguments& arguments) {
    const Json& masses = arguments.list("masses");
    if (masses.size() > kMaxWeighings / static_cast<std::size_t>(std::max(1, arguments.whole("repeats"))))
        return arguments.wrong("masses", masses.size(), fmt::format("times the repeats at most {}", kMaxWeighings));
    Json steps = Json::array();
    for (int repeat = 1; repeat <= arguments.whole("repeats"); ++repeat) {
        const auto add = [&](const Json& mass, const char* direction) {
            steps.push_back({{"mass_g", mass}, {"direction", direction}, {"repeat", repeat}});
        };
        for (auto mass = masses.begin(); mass != masses.end(); ++mass) add(*mass, "up");
        for (auto mass = masses.rbegin(); mass != masses.rend(); ++mass) add(*mass, "down");
    }
    return steps;
}

Result<Json> knownWeight(ScriptSession&, const Arguments& arguments) {
    const Json& reading = arguments.any("reading");
    const Json& rest = arguments.object("rest");
    const double tolerance_pct = arguments.number("tolerance");
    Json check = {{"mass_g", nullptr},
                  {"reference_n", nullptr},
                  {"measured", nullptr},
                  {"expanded_uncertainty", nullptr},
                  {"deviation_pct", nullptr},
                  {"expanded_uncertainty_pct", nullptr},
                  {"allowed_pct", tolerance_pct},
                  {"verdict", "not evaluated"},
                  {"passed", nullptr}};
    if (reading.is_null()) return Json{{"check", check}, {"reason", ""}};
    const auto weight = weightReadingFrom(reading);
    if (!weight) return arguments.wrong("reading", reading, "what bench.measureWeight() returned");
    check["mass_g"] = numberOrNull(weight->mass_g);
    check["reference_n"] = weight->reference_n;
    check["unit"] = weight->inUse ? Json(symbolOf(weight->inUse->unit)) : Json();
    const Json& atRest = valueOr(rest, "force_in_use");
    const double measured = weight->inUse ? weight->inUse->mean - numberOr(atRest, "mean") : kNaN;
    double expanded = kNaN;
    if (std::isfinite(measured)) {
        check["measured"] = measured;
        if (weight->inUse->unit == StreamUnit::Newton) {
            const auto known = [&](const char* key) {
                const double percent = arguments.number(key);
                return percent > 0 ? percent / 100 : kNaN;
            };
            expanded = weightError(*weight, {numberOr(atRest, "mean"), StreamUnit::Newton, numberOr(atRest, "u")},
                                   known("options.weight_tolerance_pct"), known("options.gravity_tolerance_pct"))
                           .expanded;
            const double percent = 100 / weight->reference_n;
            check["deviation_pct"] = percent * (measured - weight->reference_n);
            check["expanded_uncertainty"] = numberOrNull(expanded);
            check["expanded_uncertainty_pct"] = numberOrNull(percent * expanded);
            check["verdict"] =
                guardBandedName(percent * (measured - weight->reference_n), percent * expanded, tolerance_pct);
        } else {
            const bool standsOut = std::abs(measured) > kStandsOut * rest.at("force").at("sd").get<double>();
            check["verdict"] = nameOf(standsOut ? Verdict::Pass : Verdict::Fail);
        }
    }
    const bool passed = check["verdict"] == "pass";
    check["passed"] = passed;
    return Json{{"check", check}, {"reason", passed ? std::string() : whyNot(check, measured, expanded)}};
}

Result<Json> sensorVerdict(ScriptSession&, const Arguments& arguments) {
    const Json& results = arguments.object("results");
    Json verdict = results.at("verdict");
    Json reasons = results.at("accepted") == true ? Json::array({toldApart(results)}) : results.at("reasons");
    const auto putFirst = [&reasons](const Json& reason) { reasons.insert(reasons.begin(), reason); };
    const Json& force = results.at("force");
    if (force.value("asked", false) && verdict == "pass") {
        verdict = "indeterminate";
        putFirst(force.at("reason"));
    }
    std::vector<Json> scales{force};
    for (const auto& taxel : results.at("taxels")) scales.push_back(taxel);
    for (const auto& scale : scales) {
        if (scale.value("follows", true) || !arguments.flag("weighed")) continue;
        verdict = "fail";
        putFirst(scale.at("reason"));
    }
    return Json{{"verdict", verdict}, {"reasons", reasons}};
}

}  // namespace tacto::host::calibration
