#include "app/cli/StudyText.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/cli/Say.h"
#include "core/study/StudySettings.h"

namespace tacto::cli {

namespace {

using Json = nlohmann::json;

Json sessionJson(const StudySession& session) {
    return {{"id", session.id},
            {"code", session.code.empty() ? Json() : Json(session.code)},
            {"number", session.number},
            {"protocol", session.protocol},
            {"basis", nameOf(session.basis)},
            {"state", nameOf(session.state)},
            {"answered", session.answered}};
}

Json consentJson(const Participant& participant) {
    if (participant.consents.empty()) return nullptr;
    return participant.consents.back().version;
}

Json procedureJson(const StudySettings& settings) {
    if (!settings.procedure) return nullptr;
    const auto& procedure = *settings.procedure;
    return {{"interval_min_s", procedure.intervalMin_s},
            {"interval_max_s", procedure.intervalMax_s},
            {"method", nameOf(procedure.method)},
            {"conditions_sha256", procedure.conditionsSha256},
            {"comparison", procedure.comparison}};
}

std::string dayOf(std::chrono::sys_seconds at) {
    return dateText(std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(at)));
}

}  // namespace

Json participantJson(const Participant& participant) {
    return {{"code", participant.readable ? Json(participant.code) : Json()},
            {"virtual", participant.virtualSeed ? Json(*participant.virtualSeed) : Json()},
            {"state", wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state)},
            {"consent", consentJson(participant)},
            {"sessions", participant.sessions}};
}

Json amendmentJson(const StudyAmendment& amendment) {
    return {{"reference", amendment.reference}, {"date", dayOf(amendment.at)}, {"changed", amendment.changed}};
}

std::string changesText(const StudyAmendment& amendment, Modality modality) {
    std::vector<std::string> words;
    for (const auto& key : amendment.changed) words.push_back(amendedWords(key, modality));
    return words.empty() ? "no setting" : fmt::format("{}", fmt::join(words, ", "));
}

Json studyJson(const Study& study) {
    const auto& settings = study.settings();
    const auto& approval = settings.approval;
    auto participants = Json::array();
    int withdrawn = 0;
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn)
            ++withdrawn;
        else
            participants.push_back(participantJson(participant));
    }
    auto sessions = Json::array();
    for (const auto& session : study.sessions()) sessions.push_back(sessionJson(session));
    auto amendments = Json::array();
    for (const auto& amendment : study.amendments()) amendments.push_back(amendmentJson(amendment));
    auto wentBack = Json::array();
    for (const auto& back : study.goingsBack()) {
        wentBack.push_back({{"date", dayOf(back.at)},
                            {"lost", back.lost},
                            {"rows", back.rows},
                            {"files", back.files},
                            {"unsealed", back.unsealed}});
    }
    return {{"title", settings.title},
            {"rehearsal", study.isRehearsal()},
            {"modality", nameOf(settings.modality)},
            {"approval",
             {{"reference", approval.reference},
              {"from", dateText(approval.from)},
              {"expires", dateText(approval.expires)},
              {"valid", approvalGate(settings, study.today()).has_value()}}},
            {"procedure", procedureJson(settings)},
            {"amendments", std::move(amendments)},
            {"went_back", std::move(wentBack)},
            {"consent_version", settings.consentVersion},
            {"participants", std::move(participants)},
            {"withdrawn", withdrawn},
            {"sessions", std::move(sessions)},
            {"adverse_events", study.adverseEventCount()},
            {"ledger_head", study.ledgerHead()}};
}

void sayStudy(const Study& study) {
    const auto& settings = study.settings();
    say("{}{}\n  modality {}\n", settings.title, study.isRehearsal() ? " (rehearsal)" : "", nameOf(settings.modality));
    say("  approval {}, {} to {}{}\n  consent form {}\n", settings.approval.reference, dateText(settings.approval.from),
        dateText(settings.approval.expires), approvalGate(settings, study.today()) ? "" : ": not valid today",
        settings.consentVersion);
    for (const auto& fact : approvedProcedure(settings)) say("    {}: {}\n", fact.what, fact.words);
    for (const auto& amendment : study.amendments())
        say("  amendment {} of {}: changed {}\n", amendment.reference, dayOf(amendment.at),
            changesText(amendment, settings.modality));
    for (const auto& back : study.goingsBack()) say("  {}\n", goingBackText(back));
    int withdrawn = 0;
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn) {
            ++withdrawn;
            continue;
        }
        const auto name = participant.readable ? participant.code : std::string("(sealed)");
        const auto consented = participant.consents.empty() ? std::string(participant.readable ? "none" : "sealed")
                                                            : participant.consents.back().version;
        say("  {}{}: {}, consent {}, sessions {}\n", name,
            participant.virtualSeed ? fmt::format(" (virtual:{})", *participant.virtualSeed) : "",
            wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state), consented,
            participant.sessions);
    }
    if (withdrawn > 0) say("  withdrawn: {}\n", withdrawn);
    for (const auto& session : study.sessions()) {
        say("  session {} of {}: {}, {}, answered {}\n", session.number,
            namedWith(session.basis, session.code.empty() ? "(sealed)" : session.code), session.protocol,
            nameOf(session.state), session.answered);
    }
    if (const auto events = study.adverseEventCount(); events > 0) say("  adverse events: {}\n", events);
    say("  ledger head {}\n", study.ledgerHead());
    // A ledger that is an older one, or has rows that are not this study's, is read all the same: it says so.
    if (const auto may = study.stillApproved(); !may && !study.isRehearsal())
        say(stderr, "No session can begin today: {}.\n", may.error().message);
    if (!study.hasKey()) say(stderr, "Codes, consents and who took part are sealed; --passphrase-file shows them.\n");
}

}  // namespace tacto::cli
