// TransitionMap.h - the steps of a sweep laid over the R–P plane: in each cell the largest step that a finger feels on
// its way through it.
//
// Thread-safety: pure functions.
#pragma once

#include <vector>

#include "core/encoding/Transitions.h"

namespace tacto {

/// Just-noticeable differences, [P][R], lowest first; NaN where no step leads through the cell. Cell i is centred on
/// i / (n − 1), the ends included.
struct TransitionMap {
    std::vector<std::vector<double>> amplitude;
    std::vector<std::vector<double>> interval;
};

/// A step counts in every cell that its way leads through. Errors: InvalidArgument unless `cells` is 2 to 101.
[[nodiscard]] Result<TransitionMap> mapOf(const std::vector<TransitionStep>& steps, int cells = 11);

}  // namespace tacto
