#include "core/analysis/transitions/StepLatency.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/analysis/transitions/NamedGroups.h"

namespace tacto {

namespace {

/// Steps of one name: what was measured, what was not.
struct MeasuredSteps {
    std::string name;
    std::vector<double> latency_s, designed_s, error_s, trains, designedTrains;
    std::size_t steps = 0;
    std::size_t slow = 0;  // took more trains than the design
};

void addStep(MeasuredSteps& group, const CapturedChange& step) {
    ++group.steps;
    const StepCourse &measured = step.measured, &designed = step.designed;
    if (std::isfinite(designed.latency_s)) group.designed_s.push_back(designed.latency_s);
    if (std::isfinite(measured.latency_s) && std::isfinite(designed.latency_s)) {
        group.latency_s.push_back(measured.latency_s);
        // Within what a measurement of the design may find, there is no difference.
        const double low = step.designedFirst.latency_s, high = step.designedLast.latency_s;
        const bool ranged = low <= designed.latency_s && designed.latency_s <= high;
        group.error_s.push_back(measured.latency_s -
                                (ranged ? std::clamp(measured.latency_s, low, high) : designed.latency_s));
    }
    if (std::isfinite(measured.trains)) group.trains.push_back(measured.trains);
    if (std::isfinite(designed.trains)) group.designedTrains.push_back(designed.trains);
    if (measured.trains > std::fmax(designed.trains, step.designedLast.trains)) ++group.slow;
}

Verdict judgeSteps(const MeasuredSteps& group, double tolerance_s, std::vector<std::string>& reasons) {
    const Statistics error = statisticsOf(group.error_s);
    const double worst = std::max(std::abs(error.min), std::abs(error.max));
    if (group.error_s.empty() || group.error_s.size() < group.steps || group.trains.size() < group.steps) {
        const std::size_t missing = group.steps - std::min(group.error_s.size(), group.trains.size());
        reasons.push_back(fmt::format("{}: {} of {} steps were not measured", group.name, missing, group.steps));
    }
    if (!group.error_s.empty() && worst > tolerance_s) {
        reasons.push_back(
            fmt::format("{}: a train carried the step {:.4f} s off the design; at most {:.4f} s are accepted",
                        group.name, worst, tolerance_s));
        return Verdict::Fail;
    }
    if (group.slow > 0) {
        reasons.push_back(fmt::format(
            "{}: {} of {} steps took more trains, {:.0f} at most, than the design says, {:.0f}", group.name, group.slow,
            group.steps, statisticsOf(group.trains).max, statisticsOf(group.designedTrains).max));
        return Verdict::Fail;
    }
    const bool whole = group.steps > 0 && group.error_s.size() == group.steps && group.trains.size() == group.steps;
    return whole ? Verdict::Pass : Verdict::Indeterminate;
}

}  // namespace

LatencyJudgement judgeLatency(std::span<const CapturedChange> steps, const std::vector<std::string>& names,
                              double tolerance_s) {
    auto groups = groupsOf<MeasuredSteps>(names);
    for (const auto& step : steps) addStep(groupNamed(groups, step.name), step);
    LatencyJudgement out;
    out.tolerance_s = tolerance_s;
    out.verdict = groups.empty() ? Verdict::Indeterminate : Verdict::Pass;
    for (const auto& group : groups) {
        const Verdict verdict = judgeSteps(group, tolerance_s, out.reasons);
        out.verdict = worseOf(out.verdict, verdict);
        out.groups.push_back({group.name, group.steps, statisticsOf(group.latency_s), statisticsOf(group.designed_s),
                              statisticsOf(group.error_s), statisticsOf(group.trains),
                              statisticsOf(group.designedTrains), verdict});
    }
    if (groups.empty()) out.reasons.emplace_back("no step was measured");
    return out;
}

}  // namespace tacto
