#include "app/run/EncodingTurn.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "app/run/PilotRows.h"
#include "core/analysis/identification/Encodings.h"
#include "core/base/Random.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/Prompt.h"
#include "core/results/ResultKind.h"

namespace tacto {

namespace {

/// A session without a usable range is complete, and has no such trial.
bool wasTested(const Study& study, const StudySession& session) {
    const auto rows = pilotRows(study, session);
    if (!rows) return false;
    return std::ranges::any_of(pilotTrials(rows->events).trials,
                               [](const IdentificationTrial& trial) { return trial.phase == TrialPhase::Test; });
}

}  // namespace

EncodingTurn encodingTurn(const Study& study, const Participant& who, const std::optional<StudySession>& continued) {
    EncodingTurn turn;
    const auto& offered = study.settings().encodings;
    if (!offered.empty()) turn.encoding = offered.front();
    if (offered.size() < 2) return turn;
    std::vector<std::string> had;
    for (const auto& session : study.sessions()) {
        if (session.participant != who.id) continue;
        if (resultTraits(session.protocol).kind != ResultKind::PilotIdentification) continue;
        if (session.state == StudySessionState::Complete && wasTested(study, session)) had.push_back(session.encoding);
    }
    const auto order = williamsOrder(offered.size(), static_cast<std::size_t>(std::max(1, who.enrolled) - 1));
    turn.encoding = continued ? continued->encoding : offered[order[had.size() % order.size()]];
    for (const auto& each : had) {
        if (each != turn.encoding) turn.earlier = each;
    }
    return turn;
}

std::vector<std::string> answersOf(const Study& study, const Participant& who) {
    const auto place = static_cast<std::size_t>(std::max(1, who.enrolled) - 1);
    std::array<std::size_t, kAnswerWays> ways{};
    std::iota(ways.begin(), ways.end(), 0U);
    Random random(study.labelSeed().value_or(0), fmt::format("places of answers {}", place / kAnswerWays));
    for (std::size_t i = kAnswerWays; i > 1; --i) std::swap(ways[i - 1], ways[random.below(i)]);
    return answersIn(ways[place % kAnswerWays]);
}

}  // namespace tacto
