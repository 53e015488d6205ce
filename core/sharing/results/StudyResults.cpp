#include "core/sharing/results/StudyResults.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/JsonText.h"
#include "core/encoding/EncodingProfile.h"
#include "core/session/SessionReader.h"
#include "core/sharing/results/SessionResults.h"

namespace tacto {

namespace {

std::vector<std::string> conditionNames() {
    std::vector<std::string> names;
    for (const auto& condition : EncodingProfile::fourConditions(0, 1)) names.push_back(condition.name);
    return names;
}

Result<SessionRecord> readSession(const Study& study, const StudySession& about) {
    SessionRecord record;
    record.about = about;
    std::vector<SessionRow> commands;
    for (const auto& part : about.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        if (!*file) continue;  // booked, and never begun
        auto rows = (*file)->events();
        if (!rows) return failure(rows);
        std::ranges::move(*rows, std::back_inserter(record.rows));
        auto given = (*file)->commands();
        if (!given) return failure(given);
        std::ranges::move(*given, std::back_inserter(commands));
    }
    record.exposure = exposureOf(commands);
    record.results = sessionResults(record.rows, conditionNames());
    if (const auto said = study.nextDay(about.id)) {
        record.results.sideEffectsAsked.emplace_back(kNextDayMoment);
        record.results.skinNextDay = said->skin();
        for (const auto& each : said->sideEffects)
            record.results.sideEffects.push_back({kNextDayMoment, each.item, each.severity, each.relation});
    }
    record.results.basis = about.basis;
    record.results.number = static_cast<std::size_t>(about.number);
    record.results.complete = about.state == StudySessionState::Complete;
    record.results.parts = about.parts.size();
    if (record.results.encoding.empty()) record.results.encoding = about.encoding;
    return record;
}

/// Days of the calendar between the beginnings of two sessions.
double daysBetween(const StudySession& first, const StudySession& other) {
    const auto dayOf = [](const StudySession& session) {
        return std::chrono::floor<std::chrono::days>(session.parts.front().begun);
    };
    return static_cast<double>((dayOf(other) - dayOf(first)).count());
}

}  // namespace

SessionExposure exposureOf(const std::vector<SessionRow>& commands) {
    SessionExposure out;
    const auto known = [](double value) { return std::isfinite(value) ? value : 0; };
    for (const auto& row : commands) {
        if (row.name != "delivered") continue;
        ++out.trains;
        out.stimulated_s += known(numberOr(row.body, "interval_s"));
        constexpr double kMilliampSecondsToMicrocoulombs = 1000;
        out.charge_uC += known(numberOr(row.body, "amplitude_ma") * numberOr(row.body, "width_s") *
                               numberOr(row.body, "pulses") * kMilliampSecondsToMicrocoulombs);
    }
    return out;
}

Result<StudyRecord> readStudyRecord(const Study& study) {
    if (!study.hasKey()) {
        return fail(ErrorCode::Unsupported, "{} was opened without its key; results need its passphrase",
                    study.folder().string());
    }
    StudyRecord out;
    out.settings = study.settings();
    out.rehearsal = study.isRehearsal();
    out.ledgerHead = study.ledgerHead();
    const auto seed = study.labelSeed();
    if (!seed) return failure(seed);
    out.labelSeed = *seed;
    out.places = study.firstPlaces();
    out.amendments = study.amendments();
    out.goingsBack = study.goingsBack();
    const auto sessions = study.sessions();
    for (const auto& session : sessions) out.bases.emplace(session.id, session.basis);
    for (const auto& participant : study.participants()) {
        ParticipantRecord record{participant, study.basisOf(participant), {}};
        for (const auto& session : sessions) {
            if (session.participant != participant.id || participant.state == ParticipantState::Withdrawn) continue;
            auto read = readSession(study, session);
            if (!read) return failure(read);
            if (!session.parts.empty()) {
                const auto& first = record.sessions.empty() ? session : record.sessions.front().about;
                read->results.days = daysBetween(first, session);
            }
            record.sessions.push_back(std::move(*read));
        }
        out.participants.push_back(std::move(record));
    }
    auto events = study.adverseEvents();
    if (!events) return failure(events);
    out.events = std::move(*events);
    return out;
}

std::vector<std::pair<SessionBasis, StudyRecord>> byBasis(const StudyRecord& study) {
    std::vector<std::pair<SessionBasis, StudyRecord>> all;
    for (const auto& [word, basis] : kSessionBases) {
        const auto isOf = [&, one = basis](const ParticipantRecord& participant) { return participant.basis == one; };
        if (std::ranges::none_of(study.participants, isOf)) continue;
        auto& part = all.emplace_back(basis, study).second;
        std::erase_if(part.participants, std::not_fn(isOf));
        std::erase_if(part.events, [&, one = basis](const auto& event) {
            const auto found = study.bases.find(event.first);
            return found != study.bases.end() && found->second != one;
        });
    }
    if (all.empty()) all.emplace_back(study.rehearsal ? SessionBasis::Virtual : SessionBasis::Person, study);
    return all;
}

BidsStudy sharedStudy(const StudyRecord& record) {
    const auto& settings = record.settings;
    BidsStudy out;
    out.title = settings.title;
    out.rehearsal = record.rehearsal;
    out.approval = settings.approval.committee.empty()
                       ? settings.approval.reference
                       : fmt::format("{}, {}", settings.approval.reference, settings.approval.committee);
    const bool electrodes = settings.modality == Modality::Electrodes;
    out.massager = !electrodes;
    out.site = std::string(nameOf(settings.site));
    if (electrodes) out.electrodeArea_cm2 = settings.electrode.area.value();
    out.license = settings.license;
    out.labelSeed = record.labelSeed;
    out.places = static_cast<std::size_t>(std::max(1, record.places > 0 ? record.places : settings.participantsMax));
    for (const auto& participant : record.participants) {
        const auto& about = participant.about;
        if (about.state == ParticipantState::Withdrawn) continue;
        BidsParticipant shared;
        shared.enrolled = static_cast<std::size_t>(std::max(0, about.enrolled));
        shared.group = std::string(wordFor<ParticipantGroup>(kParticipantGroups, about.group));
        shared.basis = participant.basis;
        shared.age = about.age;
        shared.sex = about.sex;
        shared.handedness = about.handedness;
        for (const auto& session : participant.sessions) shared.sessions.push_back(session.results);
        out.participants.push_back(std::move(shared));
    }
    return out;
}

}  // namespace tacto
