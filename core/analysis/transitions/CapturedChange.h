// CapturedChange.h - changes judged on captured trains: how far each train steps from the one before, and how soon a
// change is complete.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/statistics/Verdict.h"
#include "core/base/NaN.h"
#include "core/base/Statistics.h"

namespace tacto {

/// A train as captured; NaN: not measured. The differences are against the train before.
struct CapturedTrain {
    double amplitude_v = kNaN, interval_s = kNaN;
    double onsetUncertainty_s = kNaN;  ///< standard
    double amplitude_jnd = kNaN, interval_jnd = kNaN;
};

/// A change from one command to another, or a movement through the plane, which has no end to wait for.
struct CapturedChange {
    std::string name;
    std::vector<double> before_v = {};  ///< amplitudes of the trains before it
    std::vector<CapturedTrain> trains = {};
    bool movement = false;
    // Not of a movement:
    double from_v = kNaN, to_v = kNaN, from_s = kNaN, to_s = kNaN;
    double complete_s = kNaN, trainsTaken = kNaN;
    double fastest_s = kNaN, fewestTrains = kNaN;  ///< what no sequence of trains in the wanted steps can undercut
};

struct ChangeLimits {
    double perTrain_jnd;        ///< largest step from train to train that is wanted
    double complete_s = 2;      ///< a change is complete within this
    bool secondsAlone = false;  ///< also where steps of the wanted size cannot be so fast
};

/// One axis of the steps from train to train.
struct LargestStep {
    double jnd = kNaN;
    double from = 0, to = 0;  ///< V or s
    double uncertainty = 0;   ///< expanded, of a step; NaN: unknown
    std::size_t unmeasured = 0;
};

/// Changes of one name.
struct ChangeGroup {
    std::string name;
    std::size_t changes = 0, captured = 0;
    LargestStep amplitude, interval;
    bool completes = true;
    std::vector<double> complete_s, fastest_s, trains, fewest;
    std::size_t late = 0;        ///< after the limit, though within reach of it
    std::size_t outOfReach = 0;  ///< the limit cannot be kept at the wanted steps
    std::size_t tooMany = 0;     ///< of those, with more trains than the wanted steps take
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

/// `names` must all be there for a pass. A step's uncertainty is twice the scatter of trains of one command: a gain is
/// common to both and cancels.
[[nodiscard]] ChangeJudgement judgeChanges(std::span<const CapturedChange> changes,
                                           const std::vector<std::string>& names, const ChangeLimits& limits);

}  // namespace tacto
