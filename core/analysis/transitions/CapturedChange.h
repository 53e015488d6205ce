// CapturedChange.h - judges changes on captured trains: the size of each step from train to train, and the time until a
// change is complete.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/base/Statistics.h"

namespace tacto {

/// A captured train; NaN: not measured. Differences are relative to the previous train.
struct CapturedTrain {
    double after_s = kNaN;  ///< seconds since the change began
    double amplitude_v = kNaN, interval_s = kNaN;
    double onsetUncertainty_s = kNaN;      ///< standard uncertainty (k = 1)
    double amplitudeUncertainty_v = kNaN;  ///< standard, without the part common to neighbouring trains
    double amplitude_jnd = kNaN, interval_jnd = kNaN;
};

/// How the trains follow a step; NaN: not measured or not reached.
struct StepCourse {
    double latency_s = kNaN;   ///< from the step to the first train that shows it
    double trains = kNaN;      ///< trains until the step is complete
    double complete_s = kNaN;  ///< from the step to the train that completes it
};

enum class ChangeKind {
    Step,      ///< a step from one command to another
    Movement,  ///< through the plane, without an end to wait for
};

/// The result of bench.step() and bench.traverse().
struct CapturedChange {
    std::string name = {};  ///< name from the script; empty: none yet
    ChangeKind kind = ChangeKind::Step;
    std::vector<CapturedTrain> trains = {};
    double seconds = kNaN;  ///< duration of a movement from one end to the other
    // Only for a step:
    double at_s = kNaN;          ///< on the session's clock
    double sinceOnset_s = kNaN;  ///< since the onset of the previous train
    StepCourse measured = {};
    StepCourse designed = {};
    StepCourse designedFirst = {}, designedLast = {};  ///< range of measured results that fits the design
    StepCourse fastest = {};                           ///< lower bound for any sequence of trains in wanted steps
    double from_v = kNaN, to_v = kNaN, from_s = kNaN, to_s = kNaN;
    std::vector<double> before_v = {};        ///< amplitudes of the trains before the step
    std::vector<std::int64_t> captures = {};  ///< of the first train with the step and of the train before
};

struct ChangeLimits {
    double perTrain_jnd;        ///< largest wanted step from train to train
    double complete_s = 2;      ///< longest accepted time for a change
    bool secondsAlone = false;  ///< true if only the time is judged, even if wanted steps cannot be that fast
};

/// The largest step from train to train in amplitude or interval.
struct LargestStep {
    double jnd = kNaN;
    double from = 0, to = 0;    ///< in V or s
    double uncertainty = kNaN;  ///< expanded, of a step; NaN: unknown for a step, or no step was measured
    std::size_t unmeasured = 0;
};

/// All changes with the same name.
struct ChangeGroup {
    std::string name;
    std::size_t changes = 0, captured = 0;
    LargestStep amplitude, interval;
    bool completes = true;
    std::vector<double> complete_s, fastest_s, trains, fewest;
    std::size_t late = 0;        ///< later than the limit, although the limit was reachable
    std::size_t outOfReach = 0;  ///< the limit is unreachable with steps of the wanted size
    std::size_t tooMany = 0;     ///< changes with more trains than steps of the wanted size need
    double from_v = 0, to_v = 0, from_s = 0, to_s = 0;
    Verdict verdict = Verdict::Indeterminate;
};

struct ChangeJudgement {
    ChangeLimits limits;
    std::vector<ChangeGroup> groups;
    Verdict verdict = Verdict::Indeterminate;
    std::vector<std::string> reasons = {};
    std::vector<std::string> notes = {};  ///< changes that cannot be complete in time, with the reason
};

/// A pass needs all of `names`. The uncertainty of a step (k = 2) comes from the scatter of trains with the same
/// command and from the uncertainty of each amplitude without the common gain, which cancels.
[[nodiscard]] ChangeJudgement judgeChanges(std::span<const CapturedChange> changes,
                                           const std::vector<std::string>& names, const ChangeLimits& limits);

// Rows are grouped by name, in the order in which the names first appear.

/// Returns the group with that name and adds it if it is missing. `Group` must have a member `name`.
template <class Group>
[[nodiscard]] Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
    for (auto& group : groups) {
        if (group.name == name) return group;
    }
    groups.emplace_back().name = name;
    return groups.back();
}

/// Makes empty groups for these names, so that a name without rows is noticed.
template <class Group>
[[nodiscard]] std::vector<Group> groupsOf(const std::vector<std::string>& names) {
    std::vector<Group> groups;
    for (const auto& name : names) static_cast<void>(groupNamed(groups, name));
    return groups;
}

// Compares the measured latency of steps with the scheduler's design, for each name.

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

/// A pass needs all of `names`. A group is indeterminate if one of its steps was not measured. It fails if a step
/// differs from the design by more than `tolerance_s` or takes more trains.
[[nodiscard]] LatencyJudgement judgeLatency(std::span<const CapturedChange> steps,
                                            const std::vector<std::string>& names, double tolerance_s);

}  // namespace tacto
