// StatisticsJson.h - writes statistics as JSON in the command-line contract, for `analyze`, for scripts and for the
// session's rows. Absent values (NaN) are null.
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
/// A list entry with a reading; null stands for a failed reading and gives NaN.
[[nodiscard]] ValueKind<double> readingKind();
/// A text; an empty text is written as null.
[[nodiscard]] ValueKind<std::string> textOrNullKind();

}  // namespace tacto
