// Steps.h - the 1-2-5 ladder of scales: 1, 2, 5, 10, 20, 50, ... in every decade.
//
// Thread-safety: pure functions.
#pragma once

#include <vector>

namespace tacto::gui {

/// The smallest step not below `value`, which is above 0.
[[nodiscard]] double stepNotBelow(double value);
/// `steps` further on the ladder; a value between two steps is one away from either.
[[nodiscard]] double stepAlong(double value, int steps);
/// All steps from low to high, both included where they are steps.
[[nodiscard]] std::vector<double> stepsBetween(double low, double high);

}  // namespace tacto::gui
