// The latency of steps, name by name: what was measured against what the scheduler's design says.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/NamedGroups.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/base/Statistics.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// Steps of one name: what was measured, what was not.
struct StepGroup {
    std::string name;
    std::vector<double> latency_s, designed_s, error_s, trains, designedTrains;
    std::size_t steps = 0;
    std::size_t slow = 0;  // took more trains than the design
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
        // Within what a measurement of the design may find, there is no difference.
        const double low = value("designed_latency_low_s"), high = value("designed_latency_high_s");
        const bool ranged = low <= designed && designed <= high;
        group.error_s.push_back(latency - (ranged ? std::clamp(latency, low, high) : designed));
    }
    if (std::isfinite(value("trains"))) group.trains.push_back(value("trains"));
    if (std::isfinite(value("designed_trains"))) group.designedTrains.push_back(value("designed_trains"));
    if (value("trains") > std::fmax(value("designed_trains"), value("designed_trains_high"))) ++group.slow;
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
    if (group.slow > 0) {
        reasons.push_back(fmt::format(
            "{}: {} of {} steps took more trains, {:.0f} at most, than the design says, {:.0f}", group.name, group.slow,
            group.steps, statisticsOf(group.trains).max, statisticsOf(group.designedTrains).max));
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
    auto asked = groupsAsked<StepGroup>(arguments, *options);
    if (!asked) return failure(asked);
    auto& groups = *asked;
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("name", Json()).is_string()) {
            return arguments.wrong("a step", row, "what bench.step() returned, with a name,");
        }
        add(groupNamed(groups, row["name"].get<std::string>()), row);
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
                       {"latency_s", toJson(statisticsOf(group.latency_s))},
                       {"designed_latency_s", toJson(statisticsOf(group.designed_s))},
                       {"difference_s", toJson(statisticsOf(group.error_s))},
                       {"trains", toJson(statisticsOf(group.trains))},
                       {"designed_trains", toJson(statisticsOf(group.designedTrains))},
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

}  // namespace

std::vector<HostFunction> latencyFunctions() {
    return {
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
    };
}

}  // namespace tacto
