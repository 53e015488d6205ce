// SessionResults.h - what the rows of a pilot session come to, as it may leave the study: trials, thresholds, range,
// ratings, side effects, skin.
//
// Thread-safety: pure function.
#pragma once

#include <string>
#include <vector>

#include "core/session/SessionTypes.h"
#include "core/sharing/BidsStudy.h"

namespace tacto {

/// `rows` are the events of all parts, in order; `labels` the names offered. What no row says stays unknown; number,
/// days, complete and parts are the caller's.
[[nodiscard]] BidsSession sessionResults(const std::vector<SessionRow>& rows, std::vector<std::string> labels);

}  // namespace tacto
