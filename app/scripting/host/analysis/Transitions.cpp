// Computed transitions: the largest step from train to train, and distances as people feel them.
#include "core/encoding/Transitions.h"

#include <cmath>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JustNoticeable.h"
#include "core/encoding/TransitionMap.h"

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

/// The largest steps as a reader wants them beside each other.
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

}  // namespace

Result<Json> transitions(ScriptSession& session, const Arguments& arguments) {
    const auto lines = arguments.whole("options.lines");
    const auto traverse = arguments.number("options.traverse_s");
    // No more than a moment of computing: a stop does not wait for it.
    constexpr double kMaxSweep_s = 12'000;
    if (!(lines * traverse <= kMaxSweep_s))
        return arguments.wrong("traverse_s", traverse, fmt::format("at most {:g} s divided by the lines", kMaxSweep_s));
    const auto jumps = arguments.flag("options.jumps");
    const auto& encoding = session.bench().profile().encoding;
    const TransitionSweep sweep{static_cast<int>(lines), Seconds(traverse)};
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

Result<Json> difference(ScriptSession&, const Arguments& arguments) {
    const auto quantity = arguments.text("quantity");
    const double from = arguments.number("from"), to = arguments.number("to");
    const double w = quantity == "amplitude" ? kAmplitudeWeberFraction : kIntervalWeberFraction;
    const double size = justNoticeableDifferences(to, from, w);
    return numberOrNull(to < from ? -size : size);
}

}  // namespace tacto::host::analysis
