// PredictedFigures.h - the figures of a prediction, marked as predicted.
//
// Thread-safety: pure functions.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace tacto::host::variation {

using Json = nlohmann::json;

/// `found`: from analysis.variation(). `view`: "confusion"; "accuracy", its distribution over participants; "width" of
/// the interval against trials; "thresholds" of the participants, with the currents that the lowest and the highest
/// command give them.
[[nodiscard]] Json predictedFigure(const Json& found, std::string_view view);

}  // namespace tacto::host::variation
