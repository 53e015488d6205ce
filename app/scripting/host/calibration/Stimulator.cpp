// The calibration of a stimulator: its ranges, what was found of a quantity, and the verdict.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/CalibrationAsked.h"
#include "app/scripting/host/calibration/CalibrationObject.h"
#include "app/scripting/host/report/CalibrationTables.h"
#include "app/scripting/host/report/Cells.h"
#include "core/base/QuantityText.h"

namespace tacto::host::calibration {

namespace {

using report::listIn;

constexpr double kClock_pct = 0.5;  // how far intervals may be from the computer's clock (choice)

std::string worstOf(const Json& judged) {
    const auto any = [&judged](std::string_view verdict) {
        return std::ranges::any_of(judged, [&](const Json& one) { return textOr(one, "verdict") == verdict; });
    };
    return any("fail") ? "fail" : any("indeterminate") ? "indeterminate" : "pass";
}

/// How much of its tolerance the worst level uses; 0 where nothing says so.
double worstUse(const Json& found) {
    double worst = 0;
    for (const auto& level : listIn(found, "levels")) {
        const double use = (std::abs(numberOr(level, "worst_error")) + numberOr(level, "worst_expanded_uncertainty")) /
                           numberOr(level, "tolerance");
        if (use > worst) worst = use;
    }
    return worst;
}

}  // namespace

Result<Json> checkRanges(ScriptSession&, const Arguments& arguments) {
    for (const auto& one : kCalibratedQuantities) {
        const LevelRange range(arguments, one);
        if (!(range.low < range.high))
            return arguments.wrong(LevelRange::key(one, "min"), range.low,
                                   fmt::format("a number below {}, {:g},", LevelRange::key(one, "max"), range.high));
    }
    return Json();
}

Result<Json> knownRanges(ScriptSession&, const Arguments& arguments) {
    const Json& stored = arguments.object("stored");
    Json settings = arguments.object("settings");
    for (const auto& one : kCalibratedQuantities) {
        const Json line = stored.value(one.id, Json::object());
        const double lowest = one.perUnit * numberOr(line, "lowest");
        const double highest = one.perUnit * numberOr(line, "highest");
        if (std::isnan(lowest) || std::isnan(highest))
            return arguments.wrong("stored", stored, "what bench.calibration holds");
        if (textOr(line, "unit") == "mA") continue;
        const LevelRange range(arguments, one);
        settings[LevelRange::key(one, "min")] = std::max(lowest, range.low);
        settings[LevelRange::key(one, "max")] = std::min(highest, range.high);
    }
    return settings;
}

Result<Json> judge(ScriptSession& session, const Arguments& arguments) {
    analysis::CalibrationAsked asked;
    asked.quantity = arguments.text("quantity");
    asked.tolerance_pct = arguments.number("settings.timing_tolerance_pct");
    if (asked.quantity == kCalibratedAmplitude.id) {
        asked.tolerance_pct = arguments.number("settings.tolerance_pct");
        asked.errors.loadTolerance = arguments.number("settings.load_tolerance_pct") / 100;
        // A current source is programmed to A / |Z|, and |Z| is measured each time.
        const bool drivesCurrent = session.bench().devices().stimulator->traits().drive == Drive::Current;
        if (drivesCurrent) asked.fit.sameLevel = 0.02;
    }
    return analysis::calibrationOf(session, arguments.list("rows"), asked);
}

Result<Json> timeBase(ScriptSession&, const Arguments& arguments) {
    const Json& found = arguments.any("interval");
    if (found.is_null()) return Json("");
    if (!found.is_object()) return arguments.wrong("interval", found, "what calibration.judge() returned");
    const double off_pct = 100 * std::abs(numberOr(found, "gain") - 1);
    const double expanded_pct = 100 * numberOr(found, "gain_expanded_uncertainty");
    if (off_pct + expanded_pct <= kClock_pct) return Json("");
    return Json(fmt::format(
        "the time base is not sure: intervals by the computer's clock are read {} off, at most {} % is allowed "
        "(choice)",
        measuredText(off_pct, expanded_pct, "%"), kClock_pct));
}

Result<Json> checkVerdict(ScriptSession&, const Arguments& arguments) {
    const Json& checks = arguments.list("checks");
    const auto verdict = worstOf(checks);
    Json reasons = Json::array();
    for (const auto& check : checks)
        for (const auto& reason : listIn(check, "reasons")) reasons.push_back(reason);
    if (verdict == "pass")
        reasons =
            Json::array({textOr(arguments.object("stored"), "text") + "; it still holds at three levels of each"});
    return Json{{"verdict", verdict}, {"reasons", std::move(reasons)}};
}

Result<Json> stimulatorVerdict(ScriptSession&, const Arguments& arguments) {
    const Json& found = arguments.list("found");
    const auto clock = arguments.text("clock");
    auto verdict = worstOf(found);
    Json reasons = Json::array();
    if (!clock.empty()) {
        if (verdict == "pass") verdict = "indeterminate";
        reasons.push_back(clock + (arguments.flag("store") ? "; nothing was stored" : ""));
    }
    // The nearest to its tolerance comes first: it is the headline.
    std::vector<const Json*> nearestFirst;
    for (const auto& one : found) nearestFirst.push_back(&one);
    std::ranges::stable_sort(nearestFirst, std::greater(), [](const Json* one) { return worstUse(*one); });
    for (const auto* one : nearestFirst) {
        const auto title = report::titleOfQuantity(textOr(*one, "quantity"));
        for (const auto& reason : listIn(*one, "reasons"))
            reasons.push_back(title + ": " + (reason.is_string() ? reason.get<std::string>() : shown(reason)));
    }
    return Json{{"verdict", verdict}, {"reasons", std::move(reasons)}};
}

}  // namespace tacto::host::calibration
