#include "core/sharing/results/StudyFigures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/Statistics.h"

namespace tacto {

Result<std::vector<AnalysedSession>> analysedSessions(const ParticipantRecord& participant) {
    std::vector<AnalysedSession> all;
    for (const auto& session : participant.sessions) {
        std::vector<IdentificationTrial> trials;
        for (const auto& row : session.results.trials) trials.push_back(row.trial);
        auto found = identify(trials, session.results.labels);
        if (!found) return failure(found);
        all.push_back({&session, std::move(*found)});
    }
    return all;
}

double naturalnessOf(const BidsSession& session) {
    constexpr std::string_view kWords[] = {"totally-unnatural", "rather-unnatural", "possibly-natural",
                                           "almost-natural", "totally-natural"};
    std::vector<double> scores;
    for (const auto& rating : session.ratings) {
        const auto word = std::ranges::find(kWords, rating.value);
        if (rating.item == "naturalness" && word != std::end(kWords))
            scores.push_back(static_cast<double>(word - std::begin(kWords) + 1));
    }
    return statisticsOf(scores).mean;
}

std::vector<double> responseTimes(const BidsSession& session, const std::string& condition) {
    std::vector<double> times;
    for (const auto& row : session.trials) {
        const auto& trial = row.trial;
        if (trial.phase != TrialPhase::Test || trial.condition == kCatchCondition || !std::isfinite(trial.rt_s))
            continue;
        if (condition.empty() || trial.condition == condition) times.push_back(trial.rt_s);
    }
    std::ranges::sort(times);
    return times;
}

std::vector<SessionFigures> sessionFiguresOf(const std::vector<AnalysedSession>& sessions, const std::string& name,
                                             bool massager) {
    std::vector<SessionFigures> figures;
    for (const auto& one : sessions) {
        const auto& felt = one.session->results;
        figures.push_back({.number = felt.number,
                           .days = felt.days,
                           .detection = {felt.detection, felt.detectionLow, felt.detectionHigh},
                           .tooStrong = felt.saidTooStrong ? felt.tooStrong : kNaN,
                           .high = massager ? felt.highIntensity : felt.high.value(),
                           .impedance = felt.impedance,
                           .n = one.found.all.n,
                           .hits = one.found.all.hits,
                           .itCorrected_bits = one.found.all.itCorrected_bits,
                           .participant = name,
                           .encoding = felt.encoding,
                           .low = massager ? felt.lowIntensity : felt.low.value(),
                           .medianResponse_s = statisticsOf(responseTimes(felt)).median});
    }
    return figures;
}

PersonEncodings personEncodings(const std::vector<AnalysedSession>& sessions, const std::string& name) {
    std::vector<EncodedSession> all;
    for (const auto& one : sessions) {
        const auto& session = one.session->results;
        std::set<std::size_t> training;
        for (const auto& row : session.trials) {
            if (row.trial.phase == TrialPhase::Training) training.insert(row.trial.block);
        }
        all.push_back({session.encoding, &one.found, training.size(), responseTimes(session), naturalnessOf(session)});
    }
    return {name, encodingResults(all)};
}

Result<StudyFigures> studyFigures(SessionBasis basis, const StudyRecord& part) {
    StudyFigures out;
    out.massager = part.settings.modality == Modality::Massager;
    std::vector<PersonEncodings> people;
    for (const auto& participant : part.participants) {
        if (participant.about.state == ParticipantState::Withdrawn) continue;
        const auto sessions = analysedSessions(participant);
        if (!sessions) return failure(sessions);
        const auto name = namedWith(participant.basis, participant.about.code);
        std::ranges::move(sessionFiguresOf(*sessions, name, out.massager), std::back_inserter(out.sessions));
        people.push_back(personEncodings(*sessions, name));
    }
    out.encodings = compareEncodingsOver(std::move(people));
    out.encodings.who = peopleOf(basis);
    return out;
}

}  // namespace tacto
