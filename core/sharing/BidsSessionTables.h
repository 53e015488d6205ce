// BidsSessionTables.h - the tables of one session: trials, thresholds, ratings, side effects. Those of a session with a
// massager have strengths, and what its motor did, where others have currents, voltages and impedances.
//
// Thread-safety: pure functions.
#pragma once

#include "core/sharing/BidsStudy.h"
#include "core/sharing/BidsTable.h"

namespace tacto {

[[nodiscard]] BidsTable identificationTable(const BidsSession& session, bool massager);
[[nodiscard]] BidsTable thresholdsTable(const BidsSession& session, bool massager);
[[nodiscard]] BidsTable ratingsTable(const BidsSession& session);
[[nodiscard]] BidsTable sideEffectsTable(const BidsSession& session, bool massager);

}  // namespace tacto
