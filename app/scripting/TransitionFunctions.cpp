// Transitions: the largest step from train to train, and distances as people feel them.
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/base/JustNoticeable.h"
#include "core/encoding/TransitionMap.h"
#include "core/encoding/Transitions.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

constexpr double kWanted = kWantedPerTrain;

Json toJson(const TransitionStep& step, double jnd) {
    return {{"jnd", jnd},
            {"roughness", step.R},
            {"pressure", step.P},
            {"from_v", step.from.amplitude.value()},
            {"to_v", step.to.amplitude.value()},
            {"from_s", step.from.interval.count()},
            {"to_s", step.to.interval.count()}};
}

Json toJson(const LargestSteps& steps) {
    return {{"largest_jnd", steps.largest()},
            {"amplitude", toJson(steps.amplitude, steps.amplitude.amplitude)},
            {"interval", toJson(steps.interval, steps.interval.interval)}};
}

Json gridOf(const std::vector<std::vector<double>>& cells) {
    Json rows = Json::array();
    for (const auto& row : cells) {
        Json out = Json::array();
        for (const double cell : row) out.push_back(numberOrNull(cell));
        rows.push_back(std::move(out));
    }
    return rows;
}

/// What is too large, in sentences.
std::vector<std::string> tooLarge(const LargestSteps& steps, const char* movement) {
    std::vector<std::string> reasons;
    const auto judge = [&](const char* what, const TransitionStep& step, double jnd, double from, double to,
                           const char* unit) {
        if (jnd <= kWanted) return;
        reasons.push_back(
            fmt::format("{}: {} goes from {:.3g} to {:.3g} {} in one train, {:.1f} just-noticeable "
                        "differences, at R {:.2f}, P {:.2f}; at most {:g} are wanted",
                        movement, what, from, to, unit, jnd, step.R, step.P, kWanted));
    };
    const auto& a = steps.amplitude;
    judge("amplitude", a, a.amplitude, a.from.amplitude.value(), a.to.amplitude.value(), "V");
    const auto& t = steps.interval;
    judge("the interval", t, t.interval, t.from.interval.count(), t.to.interval.count(), "s");
    return reasons;
}

Result<Json> transitions(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.transitions", list);
    auto options = arguments.options(0, {"lines", "traverse_s", "jumps"});
    if (!options) return failure(options);
    auto lines = arguments.number(*options, "lines", 11, {2, 101, true});
    if (!lines) return failure(lines);
    auto traverse = arguments.number(*options, "traverse_s", 5, {0.1, 600});
    if (!traverse) return failure(traverse);
    auto jumps = arguments.flag(*options, "jumps", true);
    if (!jumps) return failure(jumps);
    const auto& encoding = session.bench().profile().encoding;
    const TransitionSweep sweep{static_cast<int>(*lines), Seconds(*traverse)};
    const auto report = sweepTransitions(encoding, sweep);
    if (!report) return failure(report);
    const auto map = mapOf(report->steps, sweep.lines);
    if (!map) return failure(map);

    auto reasons = tooLarge(report->gradual, "moving through the plane");
    if (*jumps) {
        for (auto& reason : tooLarge(report->abrupt, "jumping between its corners")) reasons.push_back(reason);
    }
    return Json{{"wanted_jnd", kWanted},
                {"lines", sweep.lines},
                {"traverse_s", *traverse},
                {"jumps_judged", *jumps},
                {"amplitude_ratio_per_train", encoding.amplitudeRatioPerTrain},
                {"amplitude_slew_v_per_s", encoding.amplitudeSlew_V_per_s},
                {"interval_ratio_per_train", encoding.intervalRatioPerTrain},
                {"steps", report->steps.size()},
                {"gradual", toJson(report->gradual)},
                {"abrupt", toJson(report->abrupt)},
                {"amplitude_map", gridOf(map->amplitude)},
                {"interval_map", gridOf(map->interval)},
                {"verdict", reasons.empty() ? "pass" : "fail"},
                {"reasons", reasons}};
}

Result<Json> difference(ScriptSession&, const Json& list) {
    const Arguments arguments("analysis.difference", list);
    auto quantity = arguments.text(0, "quantity");
    if (!quantity) return failure(quantity);
    if (*quantity != "amplitude" && *quantity != "interval") {
        return arguments.wrong("quantity", *quantity, "\"amplitude\" or \"interval\"");
    }
    const auto value = [&](std::size_t index) {
        return arguments.at(index).is_number() ? arguments.at(index).get<double>() : std::nan("");
    };
    const double from = value(1), to = value(2);
    const double w = *quantity == "amplitude" ? kAmplitudeWeberFraction : kIntervalWeberFraction;
    const double size = justNoticeableDifferences(to, from, w);
    return numberOrNull(to < from ? -size : size);
}

Result<Json> plotTransitions(ScriptSession&, const Json& list) {
    const Arguments arguments("plot.transitions", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    for (const char* key : {"amplitude_map", "interval_map", "gradual", "wanted_jnd"}) {
        if (!(*found)->contains(key)) return arguments.wrong("found", **found, "what analysis.transitions() returned");
    }
    const Json& gradual = (**found)["gradual"];
    const auto place = [&gradual](const char* axis) {
        const Json at = gradual.value(axis, Json::object());
        return Json{{"roughness", at.value("roughness", Json())},
                    {"pressure", at.value("pressure", Json())},
                    {"jnd", at.value("jnd", Json())}};
    };
    return Json{{"type", "transitions"},
                {"wanted_jnd", (**found)["wanted_jnd"]},
                {"amplitude", (**found)["amplitude_map"]},
                {"interval", (**found)["interval_map"]},
                {"largest_amplitude", place("amplitude")},
                {"largest_interval", place("interval")}};
}

}  // namespace

std::vector<HostFunction> transitionFunctions() {
    return {
        {"analysis",
         "transitions",
         HostKind::Function,
         {{"options.lines", "number", "", "lines along R and along P, 2 to 101; 11 where left out", true},
          {"options.traverse_s", "number", "s", "from one end of the plane to the other; 5 where left out", true},
          {"options.jumps", "true or false", "",
           "whether jumps between the corners are judged too; true where left out", true}},
         "Computes the trains of a sweep of the R-P plane with the bench's encoding and finds the largest step from "
         "one train to the next, in "
         "just-noticeable differences; at most 2 are wanted.",
         "{ verdict, reasons, wanted_jnd, gradual, abrupt, amplitude_map, interval_map, ... }; gradual and abrupt hold "
         "largest_jnd, and the worst step of amplitude and of interval { jnd, roughness, pressure, from_v, to_v, "
         "from_s, "
         "to_s }, its place being that of the later train; maps are rows of P by columns of R, null where no train "
         "went.",
         "",
         transitions},
        {"analysis",
         "difference",
         HostKind::Function,
         {{"quantity", "text", "", "\"amplitude\" or \"interval\""},
          {"from", "number or null", "", "in any unit, above 0"},
          {"to", "number or null", "", "in the same unit"}},
         "How many just-noticeable differences lie between two values; below 0 where the second is smaller.",
         "Number; null where a value is absent or not above 0.",
         "",
         difference},
        {"plot",
         "transitions",
         HostKind::Function,
         {{"found", "object", "", "from analysis.transitions()"}},
         "The largest step per train over the R-P plane, amplitude and interval beside each other.",
         "A figure, for report.figure().",
         "",
         plotTransitions},
    };
}

}  // namespace tacto
