// BidsSessionTables.h - the tables of one session: trials, thresholds, ratings, side effects.
//
// Thread-safety: pure functions.
#pragma once

#include "core/sharing/BidsStudy.h"
#include "core/sharing/BidsTable.h"

namespace tacto {

[[nodiscard]] BidsTable identificationTable(const BidsSession& session);
[[nodiscard]] BidsTable thresholdsTable(const BidsSession& session);
[[nodiscard]] BidsTable ratingsTable(const BidsSession& session);
[[nodiscard]] BidsTable sideEffectsTable(const BidsSession& session);

}  // namespace tacto
