// What the calibration of a fingertip begins and ends with.
#include <cmath>

#include "app/scripting/host/calibration/CalibrationObject.h"
#include "app/scripting/host/report/Cells.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/JsonFields.h"

namespace tacto::host::calibration {

namespace {

using report::digitsOf;

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

}  // namespace

Result<Json> weighings(ScriptSession&, const Arguments& arguments) {
    const Json& masses = arguments.list("masses");
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

Result<Json> slideRow(ScriptSession&, const Arguments& arguments) {
    Json row = arguments.object("slide");
    row.erase("track");
    return row;
}

Result<Json> knownWeight(ScriptSession&, const Arguments& arguments) {
    const Json& reading = arguments.any("reading");
    const Json& rest = arguments.object("rest");
    const double tolerance_pct = arguments.number("tolerance");
    Json check = {{"mass_g", nullptr},        {"reference_n", nullptr},       {"measured", nullptr},
                  {"deviation_pct", nullptr}, {"allowed_pct", tolerance_pct}, {"verdict", "not evaluated"},
                  {"passed", nullptr}};
    if (reading.is_null()) return Json{{"check", check}, {"reason", ""}};
    const auto weight = weightReadingFrom(reading);
    if (!weight) return arguments.wrong("reading", reading, "what bench.measureWeight() returned");
    check["mass_g"] = numberOrNull(weight->mass_g);
    check["reference_n"] = weight->reference_n;
    check["unit"] = weight->inUse ? Json(symbolOf(weight->inUse->unit)) : Json();
    const double measured =
        weight->inUse ? weight->inUse->mean - numberOr(valueOr(rest, "force_in_use"), "mean") : kNaN;
    const bool read = std::isfinite(measured);
    bool passed = false;
    if (read) {
        check["measured"] = measured;
        if (weight->inUse->unit == StreamUnit::Newton) {
            const double off_pct = 100 * std::abs(measured / weight->reference_n - 1);
            check["deviation_pct"] = off_pct;
            passed = off_pct <= tolerance_pct;
        } else {
            passed = std::abs(measured) > kStandsOut * rest.at("force").at("sd").get<double>();
        }
    }
    check["passed"] = passed;
    if (read) check["verdict"] = nameOf(passed ? Verdict::Pass : Verdict::Fail);
    if (passed) return Json{{"check", check}, {"reason", ""}};
    const auto found = read ? fmt::format("{} {}", digitsOf(measured, 4), symbolOf(weight->inUse->unit)) : "nothing";
    const auto reason = fmt::format("the known-reference check {}: {} was read under {} N; nothing was calibrated",
                                    read ? "failed" : "was not evaluated", found, digitsOf(weight->reference_n, 4));
    return Json{{"check", check}, {"reason", reason}};
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
