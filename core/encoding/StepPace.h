// StepPace.h - how soon a change can be complete when no train may differ from the one before by more than so many
// just-noticeable differences.
//
// A change of state wants to be complete within 2 s, and no train may step by more than 2 differences (science.md
// sections 4 and 12). Both at once are out of reach for large changes at the paper's intervals, whatever the encoder
// does: 10 to 40 V are 14.5 differences and take 8 trains, 16 s at one train per 2 s; 2 s to 0.5 s are 9.3, and the
// intervals in between alone last 3 s. These bounds tell such changes from those that an encoder makes too slowly.
//
// Every train is taken to lie between the two ends in amplitude and interval: a train that comes sooner than in
// either state would signal a pressure that neither has.
//
// Thread-safety: pure functions.
#pragma once

#include "core/encoding/StepResponse.h"

namespace tacto {

struct StepPace {
    int trains = 1;      ///< the fewest after the step until it has arrived, as StepResponse::trains counts them
    Seconds complete{};  ///< from the step to that train's onset, at least
};

/// The bound for steps of at most `perTrain` just-noticeable differences, above 0. Amplitudes and intervals above 0;
/// `ends.sinceOnset` from 0 to the interval before.
[[nodiscard]] StepPace fastestPace(const StepEnds& ends, double perTrain) noexcept;

}  // namespace tacto
