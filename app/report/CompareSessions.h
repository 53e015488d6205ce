// CompareSessions.h - compares two recorded sessions: first what was set differently, then every number that both hold,
// each with the uncertainty of its difference.
//
// Of the trials, the means of each condition are compared: their U is made of the scatter of both (Welch-Satterthwaite)
// and of the instrument's uncertainty, which repeating does not lessen (GUM 4.3, 5.1.2, G.4). Of results, U is the root
// of the sum of both squares; of estimates with unequal bounds, the bounds that face each other (Newcombe 1998;
// Zou and Donner 2008). Without an uncertainty on either side, U is not known.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/kinds/SessionComparison.h"
#include "core/session/Origin.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionReader;

/// What is compared of a session.
struct ComparedSession {
    SessionAbout about;
    SessionLabels labels;
    bool closed = false;
    Instant length{0};
    std::vector<SessionVerdict> verdicts;
    std::vector<SessionTrial> trials;
    std::map<std::string, nlohmann::json> settings;  ///< by name: "label", "unit", or a choice's displayed words
    Delivered delivered;
};
/// Calls `alsoTrain` for the row of each train delivered. Errors: as SessionReader.
[[nodiscard]] Result<ComparedSession> readForComparison(const SessionReader& reader,
                                                        const std::function<void(const SessionRow&)>& alsoTrain = {});

[[nodiscard]] SessionComparison compareTwo(const ComparedSession& a, const ComparedSession& b);

}  // namespace tacto
