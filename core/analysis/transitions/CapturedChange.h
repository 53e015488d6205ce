// CapturedChange.h - changes judged on captured trains: how far each train steps from the one before, and how soon a
// change is complete.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"

namespace tacto {

/// A train as captured; NaN: not measured. The differences are against the train before.
struct CapturedTrain {
    double after_s = kNaN;  ///< seconds since the change began
    double amplitude_v = kNaN, interval_s = kNaN;
    double onsetUncertainty_s = kNaN;      ///< standard
    double amplitudeUncertainty_v = kNaN;  ///< standard, but for what trains near each other share
    double amplitude_jnd = kNaN, interval_jnd = kNaN;
};

/// How trains follow a step; NaN: not measured, or it did not get that far.
struct StepCourse {
    double latency_s = kNaN;   ///< from the step to the train that carries it
    double trains = kNaN;      ///< trains until the step is complete
    double complete_s = kNaN;  ///< from the step to the train with which it is complete
};

enum class ChangeKind {
    Step,      ///< a step from one command to another
    Movement,  ///< through the plane: it has no end to wait for
};

/// The result of bench.step() and bench.traverse().
struct CapturedChange {
    std::string name = {};  ///< given by the script; empty: none yet
    ChangeKind kind = ChangeKind::Step;
    std::vector<CapturedTrain> trains = {};
    double seconds = kNaN;  ///< a movement takes from one end to the other
    // A step alone has these:
    double at_s = kNaN;          ///< on the session's clock
    double sinceOnset_s = kNaN;  ///< since the train before it
    StepCourse measured = {};
    StepCourse designed = {};
    StepCourse designedFirst = {}, designedLast = {};  ///< the range that a measurement of the design may find
    StepCourse fastest = {};                           ///< what no sequence of trains in wanted steps can undercut
    double from_v = kNaN, to_v = kNaN, from_s = kNaN, to_s = kNaN;
    std::vector<double> before_v = {};        ///< amplitudes of the trains before it
    std::vector<std::int64_t> captures = {};  ///< captures of the train that carries it, and of the one before the step
};

struct ChangeLimits {
    double perTrain_jnd;        ///< largest step from train to train that is wanted
    double complete_s = 2;      ///< a change is complete within this
    bool secondsAlone = false;  ///< judges seconds alone, also where steps of the wanted size cannot be so fast
};

/// One axis of the steps from train to train.
struct LargestStep {
    double jnd = kNaN;
    double from = 0, to = 0;    ///< V or s
    double uncertainty = kNaN;  ///< expanded, of a step; NaN: unknown of one, or none was measured
    std::size_t unmeasured = 0;
};

/// Changes of one name.
struct ChangeGroup {
    std::string name;
    std::size_t changes = 0, captured = 0;
    LargestStep amplitude, interval;
    bool completes = true;
    std::vector<double> complete_s, fastest_s, trains, fewest;
    std::size_t late = 0;        ///< after the limit, though still within reach of it
    std::size_t outOfReach = 0;  ///< the limit cannot be kept at the wanted steps
    std::size_t tooMany = 0;     ///< changes with more trains than the wanted steps take
    double from_v = 0, to_v = 0, from_s = 0, to_s = 0;
    Verdict verdict = Verdict::Indeterminate;
};

struct ChangeJudgement {
    ChangeLimits limits;
    std::vector<ChangeGroup> groups;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons = {};
    std::vector<std::string> notes = {};  ///< changes that cannot be complete in time, and why
};

/// A pass needs all of `names`. The uncertainty of a step comes from the scatter of trains of one command and of each
/// amplitude by itself, k = 2: both share a gain, which cancels.
[[nodiscard]] ChangeJudgement judgeChanges(std::span<const CapturedChange> changes,
                                           const std::vector<std::string>& names, const ChangeLimits& limits);

// Rows gathered by their names, in the order in which the names first come.

/// The group of that name, made if it is missing. `Group` has a `name`.
template <class Group>
[[nodiscard]] Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
    for (auto& group : groups) {
        if (group.name == name) return group;
    }
    groups.emplace_back().name = name;
    return groups.back();
}

/// Empty groups of these names, so that a name without rows is missed.
template <class Group>
[[nodiscard]] std::vector<Group> groupsOf(const std::vector<std::string>& names) {
    std::vector<Group> groups;
    for (const auto& name : names) static_cast<void>(groupNamed(groups, name));
    return groups;
}

// The latency of steps, name by name: what was measured against what the scheduler's design says.

struct LatencyGroup {
    std::string name;
    std::size_t steps = 0;
    Statistics latency_s, designed_s, difference_s, trains, designedTrains;
    Verdict verdict = Verdict::Indeterminate;
};

struct LatencyJudgement {
    double tolerance_s = 0;
    std::vector<LatencyGroup> groups;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons;
};

/// `names` must all be there for a pass. A step that was not measured makes its group indeterminate; one that is
/// further from the design than `tolerance_s`, or takes more trains, makes it a fail.
[[nodiscard]] LatencyJudgement judgeLatency(std::span<const CapturedChange> steps,
                                            const std::vector<std::string>& names, double tolerance_s);

}  // namespace tacto
