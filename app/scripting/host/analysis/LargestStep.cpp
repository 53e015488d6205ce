// Computed transitions: the largest step from one train to the next.
#include <cmath>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/encoding/Transitions.h"

namespace tacto::host::analysis {

namespace {

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

/// Returns the largest steps side by side, for a reader.
Json largestOf(const TransitionReport& report, double traverse_s) {
    Json rows = Json::array();
    const auto add = [&](const std::string& movement, const LargestSteps& steps) {
        for (const bool amplitude : {true, false}) {
            const auto& step = amplitude ? steps.amplitude : steps.interval;
            const double jnd = amplitude ? step.amplitude : step.interval;
            rows.push_back({{"movement", movement},
                            {"of", amplitude ? "amplitude" : "interval"},
                            {"from", amplitude ? step.from.amplitude.value() : step.from.interval.count()},
                            {"to", amplitude ? step.to.amplitude.value() : step.to.interval.count()},
                            {"unit", amplitude ? "V" : "s"},
                            {"jnd", jnd},
                            {"roughness", step.R},
                            {"pressure", step.P},
                            {"wanted", jnd <= kWanted}});
        }
    };
    add(fmt::format("across in {} s", traverse_s), report.gradual);
    add("jump between corners", report.abrupt);
    return rows;
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

/// Returns sentences about the steps that are too large.
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

}  // namespace

std::vector<HostParameter> sweepSettings(bool ofOptions) {
    using namespace takes;
    return {
        whole(ofOptions ? "options.lines" : "settings.lines", "lines along R and along P").range(2, 101).otherwise(11),
        number(ofOptions ? "options.traverse_s" : "settings.traverse_s", "s", "from one end of the plane to the other")
            .range(0.1, 600)
            .otherwise(5),
        flag(ofOptions ? "options.jumps" : "settings.jumps", "whether jumps between the corners are judged too")
            .otherwise(true)};
}

Result<Json> computedTransitions(ScriptSession& session, const Arguments& arguments, int lines, double traverse,
                                 bool jumps) {
    // Computing may take only a moment, because a stop cannot interrupt it.
    constexpr double kMaxSweep_s = 12'000;
    if (!(lines * traverse <= kMaxSweep_s))
        return arguments.wrong("traverse_s", traverse, fmt::format("at most {:g} s divided by the lines", kMaxSweep_s));
    const auto& encoding = session.bench().profile().encoding;
    const TransitionSweep sweep{lines, Seconds(traverse)};
    const auto report = sweepTransitions(encoding, sweep);
    if (!report) return failure(report);
    const auto map = mapOf(report->steps, sweep.lines);
    if (!map) return failure(map);

    auto reasons = tooLarge(report->gradual, "moving through the plane");
    if (jumps) {
        for (auto& reason : tooLarge(report->abrupt, "jumping between its corners")) reasons.push_back(reason);
    }
    return Json{{"wanted_jnd", kWanted},
                {"lines", sweep.lines},
                {"traverse_s", traverse},
                {"jumps_judged", jumps},
                {"amplitude_ratio_per_train", encoding.amplitudeRatioPerTrain},
                {"amplitude_slew_v_per_s", encoding.amplitudeSlew_V_per_s},
                {"interval_ratio_per_train", encoding.intervalRatioPerTrain},
                {"steps", report->steps.size()},
                {"largest", largestOf(*report, traverse)},
                {"gradual", toJson(report->gradual)},
                {"abrupt", toJson(report->abrupt)},
                {"amplitude_map", gridOf(map->amplitude)},
                {"interval_map", gridOf(map->interval)},
                {"verdict", reasons.empty() ? "pass" : "fail"},
                {"reasons", reasons}};
}

namespace {

Result<Json> transitions(ScriptSession& session, const Arguments& arguments) {
    return computedTransitions(session, arguments, arguments.whole("options.lines"),
                               arguments.number("options.traverse_s"), arguments.flag("options.jumps"));
}

}  // namespace

}  // namespace tacto::host::analysis

namespace tacto {

std::vector<HostFunction> transitionAnalysis() {
    return {
        {.name = "transitions",
         .parameters = host::analysis::sweepSettings(true),
         .text = "Computes the trains of a sweep of the R-P plane with the bench's encoding and finds the largest step "
                 "from one train to the next, in just-noticeable differences; at most 2 are wanted.",
         .returns = "{ verdict, reasons, wanted_jnd, gradual, abrupt, amplitude_map, interval_map, ... }; gradual and "
                    "abrupt hold largest_jnd, and the worst step of amplitude and of interval { jnd, roughness, "
                    "pressure, from_v, to_v, from_s, to_s }, its place being that of the later train; maps are rows of "
                    "P by columns of R, null where no train went.",
         .call = host::analysis::transitions},
    };
}

}  // namespace tacto
