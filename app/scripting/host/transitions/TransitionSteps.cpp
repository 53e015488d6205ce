// The object "bench.transitions", the steps of the transitions protocol: the functions for scripts and what each does.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/analysis/RunAnalysis.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/transitions/Changes.h"
#include "core/encoding/Transitions.h"

namespace tacto {

namespace host::transitions {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The state of a run.
struct TransitionRun {
    double load_ohm = 0, load_pct = 0, latency_s = 0;
    ChangeLimits limits{kWantedPerTrain};
    double traverse_s = 0;
    std::vector<std::string> stepNames, names;  ///< steps with a judged latency; all changes
    TransitionsFound found = {};
    Json reference = {};  ///< null until the known load was read
};

Json resultsOf(const TransitionRun& run) {
    Json results = toJson(run.found);
    if (!run.reference.is_null()) results["reference"] = run.reference;
    return results;
}

/// Judges everything captured so far, and keeps the result in case the run ends early.
void judge(ScriptSession& session, TransitionRun& run) {
    TransitionsFound& found = run.found;
    std::vector<CapturedChange> all;
    for (const auto* some : {&found.steps, &found.jumps, &found.movements})
        all.insert(all.end(), some->begin(), some->end());
    found.latency = judgeLatency(found.steps, run.stepNames, run.latency_s);
    found.changes = judgeChanges(all, run.names, run.limits);
    session.keepPartial(resultsOf(run), Json::array());
}

std::string limitsText(const EncodingProfile& encoding) {
    std::vector<std::string> limits;
    const auto add = [&](double limit, const char* text) {
        if (limit > 0) limits.push_back(fmt::format(fmt::runtime(text), limit));
    };
    add(encoding.amplitudeRatioPerTrain, "amplitude at most {} times the one before");
    add(encoding.amplitudeSlew_V_per_s, "amplitude by at most {} V/s");
    add(encoding.intervalRatioPerTrain, "interval at most {} times the one before");
    if (limits.empty()) return "No limits on a step: a change is taken in one train.";
    return fmt::format("Limits on a step from train to train, either way: {}.", fmt::join(limits, ", "));
}

/// Returns NaN if one value was not measured.
template <class Of>
double largest(const std::vector<ChangeGroup>& groups, const Of& of) {
    double most = -kInfinity;
    for (const auto& group : groups) {
        const double value = of(group);
        if (!std::isfinite(value)) return kNaN;
        most = std::max(most, value);
    }
    return most;
}

/// States what the captures leave uncertain about a step: the largest of all changes, which the verdict includes.
std::string openText(const std::vector<ChangeGroup>& groups) {
    const double amplitude = largest(groups, [](const ChangeGroup& group) { return group.amplitude.uncertainty; });
    const double interval = largest(groups, [](const ChangeGroup& group) { return group.interval.uncertainty; });
    if (std::isnan(amplitude) || std::isnan(interval)) return "What captures leave open of a step is unknown. ";
    return fmt::format(
        "Captures leave ± {} differences of amplitude open, by the scatter of trains of one command and what the "
        "oscilloscope states, and ± {} of interval. ",
        report::digitsOf(amplitude, 2), report::digitsOf(interval, 2));
}

/// States what is required and what is impossible, before the figures.
std::string askedText(const ChangeLimits& limits) {
    return fmt::format(
        "Judged on captured trains: no train differs from the one before by more than 2 just-noticeable differences (w "
        "= "
        "0.10 of amplitude, a choice, and 0.16 of interval, Jones et al. 2009), and a change of state is complete "
        "within "
        "{} s. (choice) Both at once are out of reach for large changes at these intervals, whatever the encoder does: "
        "the steps in between are trains, and trains take their intervals. {}",
        limits.complete_s,
        limits.secondsAlone ? "Such a change fails here."
                            : "Such a change is judged by its trains: it passes with the fewest that steps of 2 "
                              "differences take. (choice)");
}

double least(const std::vector<double>& values) { return values.empty() ? kNaN : *std::ranges::min_element(values); }
double most(const std::vector<double>& values) { return values.empty() ? kNaN : *std::ranges::max_element(values); }

/// Returns the words of a pass: what was found, and why the wanted time cannot be reached.
std::vector<std::string> passedReasons(const ChangeJudgement& changes) {
    const double largest_jnd = largest(
        changes.groups, [](const ChangeGroup& group) { return std::max(group.amplitude.jnd, group.interval.jnd); });
    std::vector<std::string> out = {
        fmt::format("No captured train differs from the one before by more than {:.2f} just-noticeable "
                    "differences; at most 2 are wanted",
                    largest_jnd)};
    std::size_t ending = 0, beyond = 0;
    double least_s = kInfinity, most_s = -kInfinity;
    for (const auto& group : changes.groups) {
        if (!group.completes) continue;
        ++ending;
        if (group.outOfReach == 0) continue;
        ++beyond;
        least_s = std::min(least_s, least(group.fastest_s));
        most_s = std::max(most_s, most(group.complete_s));
    }
    const double within_s = changes.limits.complete_s;
    if (beyond < ending)
        out.push_back(
            fmt::format("{} of {} kinds of change are complete within {} s", ending - beyond, ending, within_s));
    if (beyond > 0)
        out.push_back(fmt::format(
            "{} of {} kinds of change cannot be complete within {} s in steps of at most 2 differences ({:.1f} s at "
            "least); they were, after {:.1f} s at most, with the fewest trains that such steps take, which is what is "
            "judged there (choice)",
            beyond, ending, within_s, least_s, most_s));
    return out;
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    TransitionRun first;
    first.load_ohm = arguments.number("settings.load");
    first.load_pct = arguments.number("settings.load_tolerance_pct");
    first.latency_s = arguments.number("settings.latency_tolerance_s");
    first.limits.complete_s = arguments.number("settings.complete_s");
    first.limits.secondsAlone = arguments.text("settings.complete") == "seconds";
    first.traverse_s = arguments.number("settings.traverse_s");
    first.stepNames = arguments.list("steps").get<std::vector<std::string>>();
    first.names = first.stepNames;
    for (const auto& name : arguments.list("changes")) first.names.push_back(name);
    auto computed = analysis::computedTransitions(session, arguments, arguments.whole("settings.lines"),
                                                  first.traverse_s, arguments.flag("settings.jumps"));
    if (!computed) return failure(computed);
    first.found.computed = std::move(*computed);
    const auto run = session.begin(arguments.object(), std::move(first));
    if (!run) return failure(run);
    session.keepPartial(resultsOf(**run), Json::array());
    return done(session.reportText(limitsText((*run)->found.computed.encoding)));
}

Result<Json> knownLoad(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<TransitionRun>(arguments.object());
    if (!run) return failure(run);
    auto known = bench::knownLoad(session, (*run)->load_ohm, (*run)->load_pct);
    if (!known) return known;
    (*run)->reference = std::move(*known);
    return (*run)->reference.at("passed");
}

Place placeFrom(const Arguments& arguments, const std::string& name) {
    return {arguments.number("change." + name + ".roughness"), arguments.number("change." + name + ".pressure")};
}

/// Returns the state of the run if it has this change to make.
Result<TransitionRun*> runOf(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<TransitionRun>(arguments.object());
    if (!run) return failure(run);
    const auto name = arguments.text("change.name");
    const auto& names = (*run)->names;
    if (std::ranges::find(names, name) == names.end())
        return arguments.wrong("name", name, "a name that begin() was given");
    return *run;
}

Result<Json> step(ScriptSession& session, const Arguments& arguments) {
    const auto begun = runOf(session, arguments);
    if (!begun) return failure(begun);
    TransitionRun& run = **begun;
    auto change = captureStep(session, placeFrom(arguments, "from"), placeFrom(arguments, "to"),
                              arguments.number("change.phase"));
    if (!change) return failure(change);
    const Json trial = toJson(*change);
    change->name = arguments.text("change.name");
    const bool counts = std::ranges::find(run.stepNames, change->name) != run.stepNames.end();
    if (auto added = session.addTrial(change->name, trial); !added) return failure(added);
    (counts ? run.found.steps : run.found.jumps).push_back(std::move(*change));
    judge(session, run);
    return Json();
}

Result<Json> addMovement(const Arguments& arguments, TransitionRun& run, Result<CapturedChange> change) {
    if (!change) return failure(change);
    change->name = arguments.text("change.name");
    run.found.movements.push_back(std::move(*change));
    return Json();
}

Result<Json> traverse(ScriptSession& session, const Arguments& arguments) {
    const auto run = runOf(session, arguments);
    if (!run) return failure(run);
    return addMovement(
        arguments, **run,
        captureMovement(session, placeFrom(arguments, "from"), placeFrom(arguments, "to"), (*run)->traverse_s));
}

Result<Json> press(ScriptSession& session, const Arguments& arguments) {
    const auto run = runOf(session, arguments);
    if (!run) return failure(run);
    return addMovement(arguments, **run,
                       capturePress(session, placeFrom(arguments, "from"), placeFrom(arguments, "to")));
}

/// The captures decide; a design that steps too far elsewhere in the plane makes the verdict indeterminate.
Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<TransitionRun>(arguments.object());
    if (!begun) return failure(begun);
    TransitionRun& run = **begun;
    if (run.reference.is_null())
        return fail(ErrorCode::InvalidArgument, "{0}.conclude: {0}.knownLoad() is expected first", arguments.object());
    judge(session, run);
    TransitionsFound& found = run.found;
    found.reasons.clear();
    if (auto said = session.reportText(askedText(run.limits)); !said) return failure(said);
    if (auto said = session.reportText(openText(found.changes->groups)); !said) return failure(said);
    const auto designed = found.computed.verdict == Verdict::Pass ? Verdict::Pass : Verdict::Indeterminate;
    found.verdict = worseOf(worseOf(found.changes->verdict, found.latency->verdict), designed);
    if (found.verdict == Verdict::Pass) {
        found.reasons = passedReasons(*found.changes);
        return resultsOf(run);
    }
    if (run.reference["passed"] != true)
        found.reasons.push_back(run.reference["reason"].get<std::string>() + "; nothing was measured");
    std::ranges::copy(found.changes->reasons, std::back_inserter(found.reasons));
    std::ranges::copy(found.latency->reasons, std::back_inserter(found.reasons));
    for (const auto& reason : found.computed.reasons) found.reasons.push_back("computed, not captured: " + reason);
    return resultsOf(run);
}

}  // namespace

}  // namespace host::transitions

std::vector<HostFunction> transitionFunctions() {
    using namespace takes;
    std::vector<HostParameter> settings{
        object("settings", "the parameters of the run"),
        number("settings.load", "ohm", "that is connected").range(1, 1e6),
        number("settings.load_tolerance_pct", "%", "within which it must read").range(0, 100),
        number("settings.latency_tolerance_s", "s", "accepted between measurement and design").range(0, 60),
        number("settings.complete_s", "s", "a change is complete within this").range(0.01, 600),
        text("settings.complete",
             "where steps of two differences take longer: with the fewest trains, or still in time")
            .oneOf({"trains", "seconds"})};
    for (auto& one : host::analysis::sweepSettings(false)) settings.push_back(std::move(one));
    settings.push_back(list("steps",
                            "names of the steps whose latency is judged; each must come, else the verdict cannot "
                            "be a pass")
                           .of(ValueType::Text));
    settings.push_back(list("changes", "names of the other changes, likewise").of(ValueType::Text));
    const auto place = [](std::string_view roughness, std::string_view pressure) {
        return std::vector{number(roughness, "", "R").range(0, 1), number(pressure, "", "P").range(0, 1)};
    };
    std::vector<HostParameter> movement{object("change", "{ name, from, to } of the R-P plane"),
                                        text("change.name", "one that begin() was given")};
    for (auto& one : place("change.from.roughness", "change.from.pressure")) movement.push_back(std::move(one));
    for (auto& one : place("change.to.roughness", "change.to.pressure")) movement.push_back(std::move(one));
    auto change = movement;
    change.push_back(number("change.phase", "", "when, as a share of the interval between trains").range(0.05, 0.9));
    return {
        {.name = "begin",
         .parameters = std::move(settings),
         .text = "Computes the largest steps that the encoding makes all over the R-P plane, as "
                 "analysis.transitions(), and "
                 "says its limits on a step. What was found is kept from now on, in case the run ends early.",
         .call = host::transitions::begin},
        {.name = "knownLoad",
         .text = "As bench.readKnownLoad(). The output stays armed and driven.",
         .returns = "Whether it passed.",
         .errors = "As bench.readKnownLoad().",
         .asks = {kConfirmArming},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::transitions::knownLoad},
        {.name = "step",
         .parameters = std::move(change),
         .text =
             "Lets trains run at one place of the plane, steps to another, watches the trains that follow, each in a "
             "record of its own, and records what they carried as a trial.",
         .errors =
             "Throws for a step below a just-noticeable difference, when the oscilloscope sees no two trains before "
             "it, or when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::transitions::step},
        {.name = "traverse",
         .parameters = movement,
         .text =
             "Moves through the plane at an even pace and back, and watches every train, each in a record of its own.",
         .errors = "Throws when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::transitions::traverse},
        {.name = "press",
         .parameters = std::move(movement),
         .text = "Has the finger, which drives, slide as in one condition and then as in another, and watches every "
                 "train, each in a record of its own, until they are steady. Where the fingertip's board encodes, they "
                 "are the board's. On a rig that cannot present surfaces the operator is asked to (question "
                 "surface-MATERIAL).",
         .errors = "Throws when the trains do not become steady within 60 s; without a fingertip, or an answer; when "
                   "its board encodes by another profile; or when the run is stopped.",
         .asks = {"surface-*"},
         .needs = Role::Oscilloscope,
         .call = host::transitions::press},
        {.name = "conclude",
         .text =
             "Judges the changes on the trains as captured, name by name: the largest step from train to train with "
             "its uncertainty, the time until a change is complete, and the latency of steps against the scheduler's "
             "design.",
         .returns = "What verdict() takes; its transitions are for plot.transitions().",
         .call = host::transitions::conclude},
    };
}

}  // namespace tacto
