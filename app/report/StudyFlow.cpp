#include "app/report/StudyFlow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/report/NumberText.h"
#include "app/report/StudyText.h"
#include "core/base/JsonText.h"
#include "core/pilot/PilotRecord.h"
#include "core/sharing/BidsFiles.h"
#include "core/study/StudySettings.h"

namespace tacto {

namespace {

QString shown(const std::string& value) { return value.empty() ? QString("–") : QString::fromStdString(value); }

/// Returns "3 severe", or a dash without a score.
QString scored(std::span<const char* const> words, std::optional<int> score) {
    return score ? QString::fromStdString(scoreText(words, *score)) : QString("–");
}

QString score(std::optional<int> value) { return value ? QString::number(*value) : QString("–"); }

std::size_t rowsOf(const SessionRecord& session, std::string_view kind) {
    return static_cast<std::size_t>(
        std::ranges::count_if(session.rows, [&](const SessionRow& each) { return each.name == kind; }));
}

bool hasTestTrials(const SessionRecord& session) {
    return std::ranges::any_of(session.results.trials,
                               [](const BidsTrial& row) { return row.trial.phase == TrialPhase::Test; });
}

bool withMassager(const StudyRecord& study) { return study.settings.modality == Modality::Massager; }

/// Returns the highest current, or intensity of a massager, presented in any part of the session.
double highestLevel(const SessionRecord& session, const char* key) {
    double most = kNaN;
    for (const auto& each : session.rows) {
        if (each.name != row::kTrialBegin) continue;
        const double level = numberOr(each.body, key);
        if (std::isfinite(level)) most = std::isnan(most) ? level : std::max(most, level);
    }
    return most;
}

/// Returns the participant's name for a row, with the basis of the row's data.
QString rowName(const BidsStudy& shared, const ParticipantRecord& participant, ShownName name = ShownName::Label) {
    const auto enrolled = static_cast<std::size_t>(std::max(0, participant.about.enrolled));
    return shown(namedWith(participant.basis, name == ShownName::Code ? participant.about.code
                                                                      : bidsLabel(shared, enrolled).value_or("–")));
}

/// Returns the sentence for kept records in which every check passed.
QString noRefusalText(const StudyRecord& study) {
    const bool anyCheck = std::ranges::any_of(study.participants, [](const auto& participant) {
        return std::ranges::any_of(participant.sessions,
                                   [](const auto& session) { return rowsOf(session, row::kGate) > 0; });
    });
    const bool destroyed = std::ranges::any_of(study.participants, [](const auto& participant) {
        return participant.about.state == ParticipantState::Withdrawn;
    });
    if (!anyCheck) return "no check of a session is on record";
    return destroyed ? "every check on record held; the records of participants who withdrew are destroyed"
                     : "every check on record held";
}

QString dayText(std::chrono::sys_seconds at) {
    return shown(dateText(std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(at))));
}

/// Returns the days of the first and the last session.
QString heldText(const StudyRecord& study) {
    std::vector<std::chrono::sys_seconds> all;
    for (const auto& participant : study.participants)
        for (const auto& session : participant.sessions)
            for (const auto& part : session.about.parts) all.push_back(part.begun);
    if (all.empty()) return "none";
    const auto [first, last] = std::ranges::minmax(all);
    return QString("%1 to %2").arg(dayText(first), dayText(last));
}

/// Counts people by what may be told of them without telling who they are, as in an export.
QString aboutText(const StudyRecord& study) {
    std::vector<BidsAbout> people;
    for (const auto& [about, basis, sessions] : study.participants)
        if (basis != SessionBasis::Virtual && mayBeShared(about, !sessions.empty()))
            people.push_back({about.age, about.sex, about.handedness});
    if (people.empty()) return "no person had a session";
    const auto shared = sharedAbout(std::move(people), {.age = true, .sex = true, .handedness = true});
    std::map<QString, int> counts;
    for (const auto& each : shared.people) {
        QStringList said;
        for (const auto& [told, text] : {std::pair{shared.columns.age, &each.age},
                                         {shared.columns.sex, &each.sex},
                                         {shared.columns.handedness, &each.handedness}})
            if (told) said << (text->empty() ? QString("unknown") : shown(*text));
        if (!said.isEmpty()) ++counts[said.join(", ")];
    }
    QStringList all;
    for (const auto& [said, n] : counts) all << QString("%1: %2").arg(said).arg(n);
    if (!shared.withheld.empty()) all << shown(shared.withheld);
    return all.isEmpty() ? QString("unknown") : all.join("; ");
}

}  // namespace

FactsBlock approvalFacts(const StudyRecord& study) {
    const auto& approval = study.settings.approval;
    std::map<std::string, std::map<SessionBasis, std::size_t>> consents;
    std::map<SessionBasis, std::size_t> enrolled;
    for (const auto& participant : study.participants) {
        std::set<std::string> versions;
        for (const auto& consent : participant.about.consents) versions.insert(consent.version);
        for (const auto& version : versions) ++consents[version][participant.basis];
        ++enrolled[participant.basis];
    }
    QStringList given;
    for (const auto& [version, people] : consents)
        given << QString("version %1: %2").arg(shown(version), shown(countsText(people)));
    QStringList amended;
    for (const auto& amendment : study.amendments) {
        QStringList changed;
        for (const auto& key : amendment.changed) changed << shown(amendedWords(key, study.settings.modality));
        amended << QString("%1 of %2: %3")
                       .arg(shown(amendment.reference), dayText(amendment.at),
                            changed.isEmpty() ? QString("no setting") : changed.join(", "));
    }
    const bool massager = withMassager(study);
    FactsBlock block;
    block.oneColumn = true;
    block.facts = {
        {"Modality", shown(std::string(nameOf(study.settings.modality)))},
        {"Approval", shown(approval.reference)},
        {"Committee", shown(approval.committee)},
        {"From", shown(dateText(approval.from))},
        {"Expires", shown(dateText(approval.expires))},
        {"Amendments, with the settings changed", amended.isEmpty() ? QString("none") : amended.join("; ")},
        {"Protocol", shown(approval.protocolVersion)},
        {"Hash of scripts and settings", shown(approval.protocolSha256), true},
        {"Consent form in force", shown(study.settings.consentVersion)},
        {"Consents", given.isEmpty() ? QString("none") : given.join("; ")},
        {"Participants",
         QString("%1 enrolled of at most %2").arg(shown(countsText(enrolled))).arg(study.settings.participantsMax)},
        {"Age, sex, handedness of who had a session", aboutText(study)},
        {"Sessions held", heldText(study)},
        massager ? ReportFact{"Highest strength permitted", "1, the whole of the massager's"}
                 : ReportFact{"Highest current permitted", QString("%1 mA").arg(study.settings.cap_mA)}};
    return block;
}

FactsBlock procedureFacts(const StudyRecord& study) {
    FactsBlock block;
    block.oneColumn = true;
    for (const auto& fact : approvedProcedure(study.settings))
        block.facts.push_back({shown(fact.what), shown(fact.words)});
    return block;
}

FactsBlock particularsFacts(const StudyRecord& study) {
    FactsBlock block;
    block.oneColumn = true;
    const auto known = particularsOf(study.notes);
    for (const auto& field : (*studyLogKind(kParticulars))->fields) {
        if (isOfElectrodes(field) && withMassager(study)) continue;
        block.facts.push_back({field.label, shown(known.text(field.key))});
    }
    return block;
}

TableBlock notesTable(const StudyRecord& study, const StudyLogKind& kind, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Noted on"}};
    for (const auto& field : kind.fields) table.columns.push_back({field.label});
    for (const auto& note : study.notes) {
        if (note.kind != kind.key) continue;
        QStringList row{dayText(note.at)};
        for (const auto& field : kind.fields) row << shown(note.text(field.key));
        table.rows.push_back(std::move(row));
    }
    return table;
}

TableBlock reasonsTable(const StudyRecord& study, const QString& caption) {
    std::map<std::pair<QString, QString>, int> counts;
    for (const auto& note : study.notes)
        if (note.kind == kAssessed) ++counts[{"Assessed and not enrolled", shown(note.text("reason"))}];
    for (const auto& participant : study.participants) {
        const auto& about = participant.about;
        if (about.state == ParticipantState::Left)
            ++counts[{"Left", about.leftBecause.empty() ? QString("unknown") : shown(about.leftBecause)}];
    }
    TableBlock table;
    table.caption = caption;
    table.columns = {{"What"}, {"Reason"}, {"People", true}};
    for (const auto& [what, n] : counts) table.rows.push_back({what.first, what.second, QString::number(n)});
    return table;
}

TableBlock flowTable(const StudyRecord& study, SessionBasis basis, const QString& caption) {
    std::size_t consented = 0, begun = 0, usable = 0, tested = 0, complete = 0, left = 0, withdrawn = 0;
    for (const auto& participant : study.participants) {
        const auto& about = participant.about;
        const auto any = [&](auto&& holds) { return std::ranges::any_of(participant.sessions, holds) ? 1U : 0U; };
        if (about.state == ParticipantState::Left) ++left;
        if (about.state == ParticipantState::Withdrawn) {
            ++withdrawn;
            continue;
        }
        if (!about.consents.empty()) ++consented;
        if (!participant.sessions.empty()) ++begun;
        usable += any([](const SessionRecord& session) { return hasUsableRange(session.results); });
        tested += any(hasTestTrials);
        complete += any([](const SessionRecord& session) {
            return session.about.state == StudySessionState::Complete && hasTestTrials(session);
        });
    }
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Step"}, {peopleHeading(basis), true}};
    const auto notEnrolled = static_cast<std::size_t>(std::ranges::count(study.notes, kAssessed, &StudyNote::kind));
    if (basis == SessionBasis::Person && notEnrolled > 0)
        table.rows.push_back({"Assessed", QString::number(study.participants.size() + notEnrolled)});
    for (const auto& [step, people] : {std::pair<const char*, std::size_t>{"Enrolled", study.participants.size()},
                                       {"Consented", consented},
                                       {"Began a session", begun},
                                       {"Had a usable range", usable},
                                       {"Answered test trials", tested},
                                       {"Completed a session with test trials", complete},
                                       {"Left, data kept", left},
                                       {"Withdrew, data destroyed (not in the rows between)", withdrawn}})
        table.rows.push_back({step, QString::number(people)});
    return table;
}

TableBlock courseTable(const StudyRecord& study, ShownName name, const QString& caption) {
    const auto shared = sharedStudy(study);
    TableBlock table;
    table.caption = caption;
    const bool massager = withMassager(study);
    table.columns = {{"Participant"},
                     {"Session", true},
                     {"Detection before a block over that before the test"},
                     {massager ? "Vibrations" : "Trains", true},
                     {"Stimulated (min)", true}};
    if (!massager) {
        table.columns.push_back({"Charge of leading phases (µC)", true});
        table.columns.push_back({"Impedance at the start", true});
    }
    for (const auto& participant : study.participants) {
        for (const auto& session : participant.sessions) {
            QStringList drift;
            for (const auto& each : session.results.drift) {
                const double ratio = each.detection / session.results.detection;
                drift << QString("block %1: %2%3")
                             .arg(each.block)
                             .arg(figureText(ratio, 2), each.adapted ? ", adapted" : "");
            }
            table.rows.push_back({rowName(shared, participant, name), QString::number(session.about.number),
                                  drift.isEmpty() ? "–" : drift.join("; "), QString::number(session.exposure.trains),
                                  figureText(session.exposure.stimulated_s / 60, 1)});
            if (massager) continue;
            table.rows.back() << figureText(session.exposure.charge_uC, 1)
                              << quantityText(session.results.impedance.value(), "ohm");
        }
    }
    return table;
}

TableBlock careTable(const StudyRecord& study, const QString& caption) {
    const auto shared = sharedStudy(study);
    TableBlock table;
    table.caption = caption;
    const bool massager = withMassager(study);
    const char* const highest = massager ? "Highest strength (0 to 1)" : "Highest (mA)";
    table.columns = {{"Participant"},           {"Session", true},       {"State"},
                     {highest, true},           {"Presentations", true}, {"Stops by the participant", true},
                     {"by the operator", true}, {"Faults", true},        {"Skin before", true},
                     {"Skin after", true}};
    for (const auto& participant : study.participants) {
        for (const auto& session : participant.sessions) {
            const double most = highestLevel(session, massager ? "intensity" : "current_ma");
            table.rows.push_back({rowName(shared, participant), QString::number(session.about.number),
                                  shown(std::string(nameOf(session.about.state))), figureText(most, massager ? 2 : 1),
                                  QString::number(rowsOf(session, row::kTrialBegin)),
                                  QString::number(rowsOf(session, row::kParticipantStop)),
                                  QString::number(rowsOf(session, row::kOperatorStop)),
                                  QString::number(rowsOf(session, row::kFault)), score(session.results.skinBefore),
                                  score(session.results.skinAfter)});
        }
    }
    return table;
}

TableBlock sideEffectsTable(const StudyRecord& study, ShownName name, const QString& caption) {
    const auto shared = sharedStudy(study);
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Participant"}, {"Session", true}, {"Before"},
                     {"After"},       {"A day after"},   {"Skin a day after", true}};
    const auto said = [](const BidsSession& session, const char* moment) {
        if (std::ranges::find(session.sideEffectsAsked, moment) == session.sideEffectsAsked.end())
            return QString("not asked");
        QStringList all;
        for (const auto& each : session.sideEffects) {
            if (each.moment != moment) continue;
            all << QString("%1 (%2; relation %3)")
                       .arg(QString::fromStdString(each.item), scored(kSideEffectSeverities, each.severity),
                            scored(kRelations, each.relation));
        }
        return all.isEmpty() ? QString("nothing") : all.join("; ");
    };
    for (const auto& participant : study.participants) {
        for (const auto& session : participant.sessions) {
            const auto& results = session.results;
            table.rows.push_back({rowName(shared, participant, name), QString::number(session.about.number),
                                  said(results, "before"), said(results, "after"), said(results, kNextDayMoment),
                                  results.skinNextDay ? score(results.skinNextDay) : QString("not asked")});
        }
    }
    return table;
}

TableBlock refusalsTable(const StudyRecord& study, const QString& caption) {
    const auto shared = sharedStudy(study);
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Participant"}, {"Session", true}, {"Check"}, {"What was said"}};
    for (const auto& participant : study.participants) {
        for (const auto& session : participant.sessions) {
            for (const auto& each : session.rows) {
                if (each.name != row::kGate || !each.body.contains("holds") || flagOr(each.body, "holds")) continue;
                table.rows.push_back({rowName(shared, participant), QString::number(session.about.number),
                                      shown(textOr(each.body, "name")), shown(textOr(each.body, "said"))});
            }
        }
    }
    if (table.rows.empty()) table.rows.push_back({"–", "–", "–", noRefusalText(study)});
    return table;
}

TableBlock eventsTable(const StudyRecord& study, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Session"},  {"What"},     {"Severity"}, {"Serious"}, {"Relation"},
                     {"Expected"}, {"From, to"}, {"Action"},   {"Outcome"}, {"Reported"}};
    for (const auto& [session, event] : study.events) {
        const auto basis = study.bases.find(session);
        const auto because = event.releasedBecause.empty() ? QString() : ": " + shown(event.releasedBecause);
        const auto held = event.releasedBy.empty() ? QString("yes; holds the study")
                                                   : "yes; released by " + shown(event.releasedBy) + because;
        table.rows.push_back({shown(basis == study.bases.end() ? session : namedWith(basis->second, session)),
                              shown(event.what), QString::fromStdString(scoreText(kEventSeverities, event.severity)),
                              event.serious ? held : QString("no"),
                              QString::fromStdString(scoreText(kRelations, event.relation)),
                              shown(std::string(wordFor<Expectedness>(kExpectedness, event.expected))),
                              QString("%1, %2").arg(event.onset.empty() ? QString("unknown") : shown(event.onset),
                                                    event.ended.empty() ? QString("unknown") : shown(event.ended)),
                              shown(event.action), shown(event.outcome), event.reported ? "yes" : "no"});
    }
    return table;
}

}  // namespace tacto
