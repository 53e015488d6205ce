// StatisticsJson.h - statistics in the shapes of the command line's contract: the same for `analyze`, for scripts and
// for the session's rows. Absent values (NaN) are null.
#pragma once

#include <nlohmann/json.hpp>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/JsonText.h"
#include "core/base/Statistics.h"
#include "core/base/ValueKind.h"

namespace tacto {

/// {"mean","sd","median","min","max","n"}
[[nodiscard]] nlohmann::json toJson(const Statistics& statistics);
/// {"value","low","high"}, 95 %
[[nodiscard]] nlohmann::json toJson(const Estimate& estimate);
/// A reading in a list, where null keeps the place of one that failed: NaN.
[[nodiscard]] ValueKind<double> readingKind();
/// A text, or null for an empty one.
[[nodiscard]] ValueKind<std::string> textOrNullKind();

}  // namespace tacto
