// StepResponse.h - finds a step of the finger in the trains: the first train that shows it, and the number of trains.
//
// The same definition is used for trains seen by an oscilloscope and for trains of the design, so that they can be
// compared. A train carries a step if its amplitude, or the interval since the previous train, differs from the old
// value by more than a set fraction of a just-noticeable difference (kCarried). The step is complete with the train
// that is within this distance of the new values and is followed by a train at the new interval.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/encoding/Encoder.h"

namespace tacto {

/// In just-noticeable differences. A quarter is 2.4 % of an amplitude and 3.8 % of an interval: more than an
/// oscilloscope's uncertainty, and less than a person can feel.
inline constexpr double kCarried = 0.25;

/// A train after the step.
struct StepTrain {
    Seconds onset{0};  ///< time since the step, ≥ 0
    Volts amplitude{0};
};

/// The last train before the step, and the new command.
struct StepEnds {
    Seconds sinceOnset{0};  ///< from the onset of the last train to the step
    Command before;         ///< the command of that train
    Command after;          ///< the command wanted after the step
};

struct StepResponse {
    std::optional<Seconds> latency;   ///< from the step to the onset of the first train that carries it; empty: none
    std::optional<int> trains;        ///< trains after the step up to its completion; 1: at once; empty: never
    std::optional<Seconds> complete;  ///< from the step to the onset of the train that completes it
};

/// `trains` in time order; `carried` in just-noticeable differences, above 0.
[[nodiscard]] StepResponse respond(const StepEnds& ends, std::span<const StepTrain> trains,
                                   double carried = kCarried) noexcept;

/// The range of results expected when `designed` is measured. Under slew limits the amplitude passes kCarried slowly,
/// and a reading error of a fifth of it moves the result to the train before or after.
struct ResponseRange {
    StepResponse first;  ///< earliest latency, fewest trains
    StepResponse last;
};
[[nodiscard]] ResponseRange rangeOf(const StepEnds& ends, std::span<const StepTrain> designed) noexcept;

/// Returns the trains that the scheduler sends after the step, including slew limits, up to the completion of the step
/// and two more. Errors: InvalidArgument for an invalid profile, a `sinceOnset` outside 0 to the old interval, or slew
/// limits so tight that the step takes more than 10000 trains.
[[nodiscard]] Result<std::vector<StepTrain>> designedTrains(const EncodingProfile& profile, const StepEnds& ends);

// The shortest time for a change if no train may differ from the previous one by more than a given number of
// just-noticeable differences.
//
// A change of state should be complete within 2 s, and no train may step by more than 2 differences (science.md
// sections 4 and 12). No encoder can do both for large changes at the paper's intervals: 10 to 40 V are 14.5
// differences and need 8 trains, 16 s at one train per 2 s; 2 s to 0.5 s are 9.3 differences, and the intervals between
// them alone take 3 s. These bounds distinguish such changes from those that an encoder makes too slowly.
//
// All trains are assumed to lie between the two ends in amplitude and interval. A train at a shorter interval than in
// either state would signal a pressure that neither state has.

struct StepPace {
    int trains = 1;      ///< fewest trains up to completion, as in StepResponse::trains
    Seconds complete{};  ///< shortest time from the step to the onset of that train
};

/// Returns the bound for steps of at most `perTrain` just-noticeable differences, above 0. Amplitudes and intervals
/// must be positive; `ends.sinceOnset` from 0 to the old interval.
[[nodiscard]] StepPace fastestPace(const StepEnds& ends, double perTrain) noexcept;

}  // namespace tacto
