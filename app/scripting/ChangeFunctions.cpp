// Changes judged on captured trains: how far each train steps from the one before, and how soon a change is complete.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/NamedGroups.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/base/JustNoticeable.h"
#include "core/base/Statistics.h"
#include "core/encoding/Transitions.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();

double valueOf(const Json& row, const char* key) {
    const auto at = row.find(key);
    return at != row.end() && at->is_number() ? at->get<double>() : kUnmeasured;
}

/// One axis of the steps from train to train.
struct Axis {
    const char* name;
    double largest = kUnmeasured;  ///< just-noticeable differences
    double from = 0, to = 0;       ///< of the largest, V or s
    double uncertainty = 0;        ///< expanded, of a step; NaN = unknown
    std::size_t unmeasured = 0;
};

/// Changes of one name.
struct ChangeGroup {
    std::string name;
    std::size_t changes = 0, captured = 0;
    Axis amplitude{"the amplitude"}, interval{"the interval"};
    bool completes = true;  ///< a movement has no end to wait for
    std::vector<double> complete_s, fastest_s, trains, fewest;
    std::size_t late = 0;        ///< after the limit, though within reach of it
    std::size_t outOfReach = 0;  ///< the limit cannot be kept at the wanted steps
    std::size_t tooMany = 0;     ///< of those, with more trains than the wanted steps take
    double from_v = 0, to_v = 0, from_s = 0, to_s = 0;
};

struct ChangeLimits {
    double perTrain = kWantedPerTrain;
    double complete_s = 2;
    bool secondsAlone = false;
};

/// Scatter of the trains of one command, relative: what a capture leaves open of a ratio of two amplitudes. The
/// instrument's gain is common to both and cancels.
double scatterOf(const Json& rows) {
    double squares = 0, freedom = 0;
    for (const auto& row : rows) {
        std::vector<double> same;
        for (const auto& one : row.value("before_v", Json::array())) {
            if (one.is_number()) same.push_back(one.get<double>());
        }
        if (same.size() < 2) continue;
        const Statistics s = statisticsOf(same);
        const double freedomOfOne = static_cast<double>(same.size()) - 1;
        squares += freedomOfOne * (s.sd / s.mean) * (s.sd / s.mean);
        freedom += freedomOfOne;
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : kUnmeasured;
}

void takeStep(Axis& axis, double jnd, double from, double to) {
    if (std::isnan(jnd)) {
        ++axis.unmeasured;
    } else if (!(jnd <= axis.largest)) {
        axis.largest = jnd;
        axis.from = from;
        axis.to = to;
    }
}

void addTrains(ChangeGroup& group, const Json& row) {
    constexpr double kCoverageFactor = 2;
    const Json onsets = row.value("onsets", Json::array());
    const bool movement = !row.contains("complete_s");
    double last_v = kUnmeasured, last_s = kUnmeasured;
    if (!row.value("before_v", Json::array()).empty() && row["before_v"].back().is_number()) {
        last_v = row["before_v"].back().get<double>();
        last_s = valueOf(row, "from_s");
    }
    for (std::size_t k = 0; k < onsets.size(); ++k) {
        const Json& train = onsets[k];
        ++group.captured;
        const double now_v = valueOf(train, "amplitude_v"), now_s = valueOf(train, "interval_s");
        // The first trains of a movement have none before them to be compared with.
        if (!movement || k >= 1) takeStep(group.amplitude, valueOf(train, "amplitude_jnd"), last_v, now_v);
        if (!movement || k >= 2) {
            takeStep(group.interval, valueOf(train, "interval_jnd"), last_s, now_s);
            // Two intervals share the stamp between them: u² of ln(T2/T1) is at most 2 (2 u / T)².
            const double u = kCoverageFactor * std::sqrt(8.0) * valueOf(train, "onset_u_s") /
                             std::min(now_s, std::isnan(last_s) ? now_s : last_s) / std::log1p(kIntervalWeberFraction);
            if (!(u <= group.interval.uncertainty)) group.interval.uncertainty = u;
        }
        last_v = now_v;
        last_s = now_s;
    }
}

void addChange(ChangeGroup& group, const Json& row, const ChangeLimits& limits) {
    ++group.changes;
    addTrains(group, row);
    if (!row.contains("complete_s")) {
        group.completes = false;
        return;
    }
    group.from_v = valueOf(row, "from_v");
    group.to_v = valueOf(row, "to_v");
    group.from_s = valueOf(row, "from_s");
    group.to_s = valueOf(row, "to_s");
    const double complete = valueOf(row, "complete_s"), fastest = valueOf(row, "fastest_complete_s");
    const double trains = valueOf(row, "trains"), fewest = valueOf(row, "fewest_trains");
    if (std::isfinite(complete)) group.complete_s.push_back(complete);
    if (std::isfinite(fastest)) group.fastest_s.push_back(fastest);
    if (std::isfinite(trains)) group.trains.push_back(trains);
    if (std::isfinite(fewest)) group.fewest.push_back(fewest);
    if (complete <= limits.complete_s || std::isnan(complete)) return;
    if (limits.secondsAlone || !(fastest > limits.complete_s)) {
        ++group.late;
        return;
    }
    ++group.outOfReach;
    if (!(trains <= fewest)) ++group.tooMany;
}

struct ChangeJudgement {
    std::vector<std::string> failures, open, notes;
};

void judgeAxis(const ChangeGroup& group, const Axis& axis, const char* unit, const ChangeLimits& limits,
               ChangeJudgement& judgement) {
    const auto step = [&] {
        return fmt::format("{}: {} goes from {:.3g} to {:.3g} {} in one train, {:.2f} just-noticeable differences",
                           group.name, axis.name, axis.from, axis.to, unit, axis.largest);
    };
    if (axis.unmeasured > 0) {
        judgement.open.push_back(fmt::format("{}: {} of {} steps of {} were not measured", group.name, axis.unmeasured,
                                             group.captured, axis.name));
    }
    if (std::isnan(axis.largest)) {
        if (axis.unmeasured == 0) {
            judgement.open.push_back(fmt::format("{}: no step of {} was captured", group.name, axis.name));
        }
    } else if (std::isnan(axis.uncertainty)) {
        judgement.open.push_back(fmt::format("{}; its uncertainty is unknown", step()));
    } else if (axis.largest - axis.uncertainty > limits.perTrain) {
        judgement.failures.push_back(fmt::format("{}; at most {:g} are wanted", step(), limits.perTrain));
    } else if (!(axis.largest + axis.uncertainty <= limits.perTrain)) {
        judgement.open.push_back(fmt::format("{} ± {:.2f}; whether at most {:g}, as wanted, is open", step(),
                                             axis.uncertainty, limits.perTrain));
    }
}

std::string endsOf(const ChangeGroup& group) {
    std::string ends;
    if (group.from_v != group.to_v) ends += fmt::format("{:.3g} to {:.3g} V", group.from_v, group.to_v);
    if (group.from_s != group.to_s) {
        ends += fmt::format("{}{:.3g} to {:.3g} s", ends.empty() ? "" : ", ", group.from_s, group.to_s);
    } else {
        ends += fmt::format(" at one train every {:.3g} s", group.from_s);
    }
    return ends;
}

void judgeCompletion(const ChangeGroup& group, const ChangeLimits& limits, ChangeJudgement& judgement) {
    if (!group.completes) return;
    const Statistics complete = statisticsOf(group.complete_s), fastest = statisticsOf(group.fastest_s);
    const Statistics trains = statisticsOf(group.trains), fewest = statisticsOf(group.fewest);
    if (group.complete_s.size() < group.changes) {
        judgement.open.push_back(fmt::format("{}: {} of {} changes were not seen to be complete", group.name,
                                             group.changes - group.complete_s.size(), group.changes));
    }
    if (group.late > 0) {
        judgement.failures.push_back(
            fmt::format("{}: {} of {} changes were complete later than {:g} s, after {:.2f} s "
                        "at most",
                        group.name, group.late, group.changes, limits.complete_s, complete.max));
    }
    if (group.tooMany > 0) {
        judgement.failures.push_back(
            fmt::format("{}: {} of {} changes took more trains, {:.0f} at most, than steps of {:g} differences need, "
                        "{:.0f}",
                        group.name, group.tooMany, group.changes, trains.max, limits.perTrain, fewest.max));
    }
    if (group.outOfReach > 0) {
        judgement.notes.push_back(fmt::format(
            "{}, {}: complete after {:.2f} to {:.2f} s. {:g} s are out of reach: in steps of at most {:g} differences "
            "it takes {:.0f} trains and {:.2f} s at least; this one took {:.0f} trains",
            group.name, endsOf(group), complete.min, complete.max, limits.complete_s, limits.perTrain, fewest.max,
            fastest.min, trains.max));
    }
}

Json toJson(const ChangeGroup& group, std::string_view verdict) {
    return {{"name", group.name},
            {"n", group.changes},
            {"trains_captured", group.captured},
            {"amplitude_jnd", numberOrNull(group.amplitude.largest)},
            {"amplitude_u_jnd", numberOrNull(group.amplitude.uncertainty)},
            {"interval_jnd", numberOrNull(group.interval.largest)},
            {"interval_u_jnd", numberOrNull(group.interval.uncertainty)},
            {"completes", group.completes},
            {"complete_s", toJson(statisticsOf(group.complete_s))},
            {"fastest_complete_s", toJson(statisticsOf(group.fastest_s))},
            {"trains", toJson(statisticsOf(group.trains))},
            {"fewest_trains", toJson(statisticsOf(group.fewest))},
            {"late", group.late},
            {"out_of_reach", group.outOfReach},
            {"verdict", verdict}};
}

Result<Json> changes(ScriptSession&, const Json& list) {
    const Arguments arguments("analysis.changes", list);
    auto rows = arguments.list(0, "changes");
    if (!rows) return failure(rows);
    auto options = arguments.options(1, {"complete_s", "seconds_alone", "names"});
    if (!options) return failure(options);
    ChangeLimits limits;
    auto complete = arguments.number(*options, "complete_s", limits.complete_s, {0.01, 600});
    if (!complete) return failure(complete);
    auto alone = arguments.flag(*options, "seconds_alone", false);
    if (!alone) return failure(alone);
    limits.complete_s = *complete;
    limits.secondsAlone = *alone;

    auto asked = groupsAsked<ChangeGroup>(arguments, *options);
    if (!asked) return failure(asked);
    auto& groups = *asked;
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("name", Json()).is_string() || !row.value("onsets", Json()).is_array()) {
            return arguments.wrong("a change", row, "what bench.step() or bench.traverse() returned, with a name,");
        }
        addChange(groupNamed(groups, row["name"].get<std::string>()), row, limits);
    }
    const double scatter_jnd = 2 * std::sqrt(2.0) * scatterOf(**rows) / std::log1p(kAmplitudeWeberFraction);
    ChangeJudgement all;
    Json out = Json::array();
    for (auto& group : groups) {
        group.amplitude.uncertainty = scatter_jnd;
        ChangeJudgement own;
        if (group.changes == 0)
            own.open.push_back(fmt::format("{}: no change was captured", group.name));
        else {
            judgeAxis(group, group.amplitude, "V", limits, own);
            judgeAxis(group, group.interval, "s", limits, own);
            judgeCompletion(group, limits, own);
        }
        out.push_back(toJson(group, !own.failures.empty() ? "fail" : !own.open.empty() ? "indeterminate" : "pass"));
        all.failures.insert(all.failures.end(), own.failures.begin(), own.failures.end());
        all.open.insert(all.open.end(), own.open.begin(), own.open.end());
        all.notes.insert(all.notes.end(), own.notes.begin(), own.notes.end());
    }
    if (groups.empty()) all.open.emplace_back("no change was captured");
    const char* verdict = !all.failures.empty() ? "fail" : !all.open.empty() ? "indeterminate" : "pass";
    all.failures.insert(all.failures.end(), all.open.begin(), all.open.end());
    return Json{{"wanted_jnd", limits.perTrain},
                {"complete_limit_s", limits.complete_s},
                {"seconds_alone", limits.secondsAlone},
                {"groups", out},
                {"notes", all.notes},
                {"verdict", verdict},
                {"reasons", all.failures}};
}

}  // namespace

std::vector<HostFunction> changeFunctions() {
    return {
        {"analysis",
         "changes",
         HostKind::Function,
         {{"changes", "list", "", "from bench.step() and bench.traverse(), each with a name"},
          {"options.complete_s", "number", "s", "a change is complete within this; 2 where left out", true},
          {"options.seconds_alone", "true or false", "",
           "also where steps of two differences cannot be so fast; false where left out: such a change passes with the "
           "fewest trains that such steps take",
           true},
          {"options.names", "list", "", "names that must all be there, else the verdict cannot be a pass", true}},
         "Judges changes on the trains as captured, name by name: the largest step from train to train with its "
         "uncertainty (twice the scatter of trains of one command; a gain is common to both and cancels), and the time "
         "until a change is complete.",
         "{ verdict, reasons, notes, wanted_jnd, complete_limit_s, seconds_alone, groups }; notes say which changes "
         "cannot be complete in time and why; a group is { name, n, trains_captured, amplitude_jnd, amplitude_u_jnd, "
         "interval_jnd, interval_u_jnd, completes, complete_s, fastest_complete_s, trains, fewest_trains, late, "
         "out_of_reach, verdict }.",
         "",
         changes},
    };
}

}  // namespace tacto
