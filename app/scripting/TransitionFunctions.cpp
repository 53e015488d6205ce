// Transitions: the largest step from train to train, the latency of a change, and distances as people feel them.
#include <cmath>
#include <map>

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

/// science.md section 4: wanted per train, just-noticeable differences.
constexpr double kWanted = 2;

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
    const Json jumps = options->value("jumps", Json(true));
    if (!jumps.is_boolean()) return arguments.wrong("jumps", jumps, "true or false");
    const auto& encoding = session.bench().profile().encoding;
    const TransitionSweep sweep{static_cast<int>(*lines), Seconds(*traverse)};
    const auto report = sweepTransitions(encoding, sweep);
    if (!report) return failure(report);
    const auto map = mapOf(report->steps, sweep.lines);
    if (!map) return failure(map);

    auto reasons = tooLarge(report->gradual, "moving through the plane");
    if (jumps.get<bool>()) {
        for (auto& reason : tooLarge(report->abrupt, "jumping between its corners")) reasons.push_back(reason);
    }
    return Json{{"wanted_jnd", kWanted},
                {"lines", sweep.lines},
                {"traverse_s", *traverse},
                {"jumps_judged", jumps},
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

/// Steps of one name: what was measured, what was not.
struct StepGroup {
    std::string name;
    std::vector<double> latency_s, designed_s, error_s, trains, designedTrains;
    std::size_t steps = 0;
};

void add(StepGroup& group, const Json& step) {
    const auto value = [&step](const char* key) {
        const auto at = step.find(key);
        return at != step.end() && at->is_number() ? at->get<double>() : std::nan("");
    };
    ++group.steps;
    const double latency = value("latency_s"), designed = value("designed_latency_s");
    if (std::isfinite(designed)) group.designed_s.push_back(designed);
    if (std::isfinite(latency) && std::isfinite(designed)) {
        group.latency_s.push_back(latency);
        group.error_s.push_back(latency - designed);
    }
    if (std::isfinite(value("trains"))) group.trains.push_back(value("trains"));
    if (std::isfinite(value("designed_trains"))) group.designedTrains.push_back(value("designed_trains"));
}

std::string_view judge(const StepGroup& group, double tolerance_s, std::vector<std::string>& reasons) {
    const Statistics error = statisticsOf(group.error_s);
    const double worst = std::max(std::abs(error.min), std::abs(error.max));
    if (group.error_s.empty() || group.error_s.size() < group.steps || group.trains.size() < group.steps) {
        const std::size_t missing = group.steps - std::min(group.error_s.size(), group.trains.size());
        reasons.push_back(fmt::format("{}: {} of {} steps were not measured", group.name, missing, group.steps));
    }
    if (!group.error_s.empty() && worst > tolerance_s) {
        reasons.push_back(
            fmt::format("{}: a train carried the step {:.4f} s off the design; at most {:.4f} s are "
                        "accepted",
                        group.name, worst, tolerance_s));
        return "fail";
    }
    const Statistics took = statisticsOf(group.trains), meant = statisticsOf(group.designedTrains);
    if (took.max > meant.max + 0.5) {
        reasons.push_back(fmt::format("{}: a step took {:.0f} trains; the design says at most {:.0f}", group.name,
                                      took.max, meant.max));
        return "fail";
    }
    const bool whole = group.steps > 0 && group.error_s.size() == group.steps && group.trains.size() == group.steps;
    return whole ? "pass" : "indeterminate";
}

Result<Json> latency(ScriptSession&, const Json& list) {
    const Arguments arguments("analysis.latency", list);
    auto rows = arguments.list(0, "steps");
    if (!rows) return failure(rows);
    auto options = arguments.options(1, {"tolerance_s", "names"});
    if (!options) return failure(options);
    auto tolerance = arguments.number(*options, "tolerance_s", 0.02, {0, 60});
    if (!tolerance) return failure(tolerance);
    std::vector<StepGroup> groups;
    const auto groupOf = [&](const std::string& name) -> StepGroup& {
        for (auto& group : groups) {
            if (group.name == name) return group;
        }
        groups.emplace_back().name = name;
        return groups.back();
    };
    for (const auto& name : options->value("names", Json::array())) {
        if (!name.is_string()) return arguments.wrong("names", (*options)["names"], "a list of names");
        groupOf(name.get<std::string>());
    }
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("name", Json()).is_string()) {
            return arguments.wrong("a step", row, "what bench.step() returned, with a name,");
        }
        add(groupOf(row["name"].get<std::string>()), row);
    }
    std::vector<std::string> reasons;
    Json out = Json::array();
    bool failed = false, whole = !groups.empty();
    for (const auto& group : groups) {
        const auto verdict = judge(group, *tolerance, reasons);
        failed = failed || verdict == "fail";
        whole = whole && verdict == "pass";
        out.push_back({{"name", group.name},
                       {"n", group.latency_s.size()},
                       {"not_measured", group.steps - group.latency_s.size()},
                       {"latency_s", tacto::toJson(statisticsOf(group.latency_s))},
                       {"designed_latency_s", tacto::toJson(statisticsOf(group.designed_s))},
                       {"difference_s", tacto::toJson(statisticsOf(group.error_s))},
                       {"trains", tacto::toJson(statisticsOf(group.trains))},
                       {"designed_trains", tacto::toJson(statisticsOf(group.designedTrains))},
                       {"verdict", verdict}});
    }
    if (groups.empty()) reasons.emplace_back("no step was measured");
    return Json{{"tolerance_s", *tolerance},
                {"groups", out},
                {"verdict", failed  ? "fail"
                            : whole ? "pass"
                                    : "indeterminate"},
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
         "Sweeps the R-P plane with the bench's encoding and finds the largest step from one train to the next, in "
         "just-noticeable differences; at most 2 are wanted.",
         "{ verdict, reasons, wanted_jnd, gradual, abrupt, amplitude_map, interval_map, ... }; gradual and abrupt hold "
         "largest_jnd, and the worst step of amplitude and of interval { jnd, roughness, pressure, from_v, to_v, "
         "from_s, "
         "to_s }, its place being that of the later train; maps are rows of P by columns of R, null where no train "
         "went.",
         "",
         transitions},
        {"analysis",
         "latency",
         HostKind::Function,
         {{"steps", "list", "", "from bench.step(), each with a name"},
          {"options.tolerance_s", "number", "s", "accepted between measurement and design; 0.02 where left out", true},
          {"options.names", "list", "", "names that must all be there, else the verdict cannot be a pass", true}},
         "Judges the latency of steps, name by name, against the scheduler's design.",
         "{ verdict, reasons, tolerance_s, groups }; a group is { name, n, not_measured, latency_s, "
         "designed_latency_s, "
         "difference_s, trains, designed_trains, verdict } with statistics { mean, sd, median, min, max, n }.",
         "",
         latency},
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
