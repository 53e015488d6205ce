#include "app/run/EncodingTurn.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "app/run/PilotRows.h"
#include "core/analysis/identification/OverSessions.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Random.h"
#include "core/kinds/ResultKinds.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/Prompt.h"

namespace tacto {

namespace {

/// True if the session had test trials. A session without a usable range is complete but has none.
bool wasTested(const Study& study, const StudySession& session) {
    const auto rows = pilotRows(study, session);
    if (!rows) return false;
    return std::ranges::any_of(pilotTrials(rows->events).trials,
                               [](const IdentificationTrial& trial) { return trial.phase == TrialPhase::Test; });
}

/// Returns how many participants of the same kind were enrolled earlier: people are balanced only among people, even if
/// virtual participants are enrolled too.
std::size_t placeAmongTheirs(const Study& study, const Participant& who) {
    const auto all = study.participants();
    return static_cast<std::size_t>(std::ranges::count_if(all, [&](const Participant& each) {
        return each.enrolled < who.enrolled && each.isVirtual() == who.isVirtual();
    }));
}

/// Returns the answers in the plan of an earlier session; empty if there is none.
std::vector<std::string> answersBefore(const Study& study, const Participant& who) {
    for (const auto& session : study.sessions()) {
        if (session.participant != who.id) continue;
        const auto rows = pilotRows(study, session);
        if (!rows) continue;
        for (const auto& event : rows->events) {
            const auto places = event.name == row::kPlan ? textOr(event.body, "answers") : std::string();
            if (places.empty()) continue;
            std::vector<std::string> answers;
            for (const auto each : split(places, ',')) answers.emplace_back(each);
            return answers;
        }
    }
    return {};
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
    const auto order = williamsOrder(offered.size(), placeAmongTheirs(study, who));
    const auto next =
        *std::ranges::min_element(order, {}, [&](std::size_t one) { return std::ranges::count(had, offered[one]); });
    turn.encoding = continued ? continued->encoding : offered[next];
    for (const auto& each : had) {
        if (each != turn.encoding) turn.earlier = each;
    }
    return turn;
}

std::vector<std::string> answersOf(const Study& study, const Participant& who) {
    if (auto before = answersBefore(study, who); !before.empty()) return before;
    const auto place = placeAmongTheirs(study, who);
    std::array<std::size_t, kAnswerWays> ways{};
    std::iota(ways.begin(), ways.end(), 0U);
    Random random(study.labelSeed().value_or(0), fmt::format("places of answers {}", place / kAnswerWays));
    for (std::size_t i = kAnswerWays; i > 1; --i) std::swap(ways[i - 1], ways[random.below(i)]);
    return answersIn(ways[place % kAnswerWays]);
}

}  // namespace tacto
