// StepResponse.h - a step of the finger seen in the trains: which one carries it first, and how many the change takes.
//
// The same definition serves trains as an oscilloscope saw them and trains as the design has them, so that both may be
// compared. A train carries a step when its amplitude, or the interval since the train before it, has left what was
// there by more than a noticeable fraction (kCarried); the step has arrived with the train that is as near to the new
// ones and is followed by one at the new interval.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/encoding/Encoder.h"

namespace tacto {

/// Just-noticeable differences. A quarter is 2.4 % of an amplitude and 3.8 % of an interval: above what an oscilloscope
/// leaves open, and below what a person feels.
inline constexpr double kCarried = 0.25;

/// A train after the step.
struct StepTrain {
    Seconds onset{0};  ///< since the step, ≥ 0
    Volts amplitude{0};
};

/// The last train before the step, and what the step leads to.
struct StepEnds {
    Seconds sinceOnset{0};  ///< from that train's onset to the step
    Command before;         ///< the command of that train
    Command after;          ///< what is wanted from the step on
};

struct StepResponse {
    std::optional<Seconds> latency;   ///< time to the onset of the first train that carries the step; empty: none did
    std::optional<int> trains;        ///< trains after the step until it has arrived, 1 being at once; empty: never
    std::optional<Seconds> complete;  ///< time to the onset of the train with which it has arrived
};

/// `trains` in time order; `carried` in just-noticeable differences, above 0.
[[nodiscard]] StepResponse respond(const StepEnds& ends, std::span<const StepTrain> trains,
                                   double carried = kCarried) noexcept;

/// What a measurement of `designed` may find: under slew limits the amplitude creeps past kCarried, and a reading that
/// is off by a fifth of that moves it to the train before or after.
struct ResponseRange {
    StepResponse first;  ///< the earliest latency, the fewest trains
    StepResponse last;
};
[[nodiscard]] ResponseRange rangeOf(const StepEnds& ends, std::span<const StepTrain> designed) noexcept;

/// The trains that the scheduler sends after the step, slew limits and all: until the step has arrived, and two more.
/// Errors: InvalidArgument for a profile that is not valid, a `sinceOnset` that is not 0 to the interval before, and
/// slew limits so tight that the step takes more than 10000 trains.
[[nodiscard]] Result<std::vector<StepTrain>> designedTrains(const EncodingProfile& profile, const StepEnds& ends);

// How soon a change can be complete when no train may differ from the one before by more than so many
// just-noticeable differences.
//
// A change of state wants to be complete within 2 s, and no train may step by more than 2 differences (science.md
// sections 4 and 12). Both at once are out of reach for large changes at the paper's intervals, whatever the encoder
// does: 10 to 40 V are 14.5 differences and take 8 trains, 16 s at one train per 2 s; 2 s to 0.5 s are 9.3, and the
// intervals in between alone last 3 s. These bounds tell such changes from those that an encoder makes too slowly.
//
// Every train is taken to lie between the two ends in amplitude and interval: a train that comes sooner than in
// either state would signal a pressure that neither has.

struct StepPace {
    int trains = 1;      ///< fewest trains after the step until it has arrived, as StepResponse::trains
    Seconds complete{};  ///< from the step to that train's onset, at least
};

/// The bound for steps of at most `perTrain` just-noticeable differences, above 0. Amplitudes and intervals above 0;
/// `ends.sinceOnset` from 0 to the interval before.
[[nodiscard]] StepPace fastestPace(const StepEnds& ends, double perTrain) noexcept;

}  // namespace tacto
