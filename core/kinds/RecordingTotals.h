// RecordingTotals.h - the results of a recording while a finger drove the output.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/results/ResultKind.h"

namespace tacto {

/// What was delivered and lost; trains, or bursts of a massager.
struct RecordingTotals {
    double duration_s = 0;
    std::uint64_t delivered = 0, refused = 0, skipped = 0;
    std::uint64_t samplesLost = 0, gaps = 0;
};

// `kind` is Live or Massager.

/// Returns the results, without a verdict.
[[nodiscard]] nlohmann::json toJson(const RecordingTotals& totals, ResultKind kind);
[[nodiscard]] ResultTraits recordingKind(ResultKind kind);

}  // namespace tacto
