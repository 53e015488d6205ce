// PredictedFigures.h - the figures of a prediction, marked as predicted.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/variation/Variation.h"

namespace tacto::host::variation {

using Json = nlohmann::json;

[[nodiscard]] Json predictedConfusion(const Variation& found);
/// The distribution of the accuracy over participants.
[[nodiscard]] Json accuracyCurve(const Variation& found);
/// The width of the interval against trials.
[[nodiscard]] Json widthCurve(const Variation& found, const TrialsWanted& wanted);
/// The thresholds of the participants, with the currents that the lowest and the highest command give them (of a
/// current source: A / |Z|), even if these would be withheld.
[[nodiscard]] Json thresholdCurves(const Variation& found, const EncodingProfile& encoding);

}  // namespace tacto::host::variation
