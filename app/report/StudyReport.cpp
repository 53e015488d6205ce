#include "app/report/StudyReport.h"

#include <algorithm>
#include <map>

#include "app/report/PilotFigures.h"
#include "app/report/ReportContent.h"
#include "app/report/StudyFlow.h"
#include "app/report/StudyOverSessions.h"
#include "app/report/StudyPerson.h"
#include "app/report/StudyText.h"
#include "app/report/TableContent.h"
#include "core/analysis/identification/FewPeople.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/base/ProgramVersion.h"
#include "core/kinds/ResultKinds.h"
#include "core/sharing/results/StudyFigures.h"

namespace tacto {

namespace {

/// Returns the warning before all results that are not from people with real devices; empty for those that are.
QString warningOf(SessionBasis basis) {
    switch (basis) {
        case SessionBasis::Person:
            return {};
        case SessionBasis::PersonSimulated:
            return "SIMULATED DEVICES: people answered, and nothing was felt. These numbers say nothing of what people "
                   "feel.";
        case SessionBasis::Virtual:
            break;
    }
    return "SIMULATED: the participants are a model of people. These numbers say what the program does, not what "
           "people do.";
}

/// Counts the participants of each kind who had a session; without any session, those enrolled.
std::map<SessionBasis, std::size_t> tookPart(const StudyRecord& study) {
    std::map<SessionBasis, std::size_t> counts;
    const auto had = [](const ParticipantRecord& each) { return !each.sessions.empty(); };
    const bool any = std::ranges::any_of(study.participants, had);
    for (const auto& participant : study.participants)
        if (!any || had(participant)) ++counts[participant.basis];
    return counts;
}

/// `parts`: the kinds of participants in the report, from byBasis().
ReportContent begun(const StudyRecord& study, std::vector<SessionBasis> parts, const QString& title,
                    const QString& subtitle) {
    ReportContent content;
    // Enrolled people without a session do not make this a report about people.
    const auto counts = parts.size() > 1 ? tookPart(study) : std::map<SessionBasis, std::size_t>{{parts.front(), 1}};
    const auto simulated = std::ranges::count_if(counts, [](const auto& each) { return isSimulatedBasis(each.first); });
    content.simulated = simulated == std::ssize(counts);
    content.documentTitle = title;
    content.header = QString("Tactoscope %1  ·  %2%3")
                         .arg(programVersion().version, title,
                              content.simulated ? "  ·  simulated"
                              : simulated > 0   ? "  ·  simulated in part"
                                                : "");
    content.footer =
        QString("Study %1  ·  ledger head %2…").arg(qtext(study.settings.id), qtext(study.ledgerHead).left(12));
    content.blocks.emplace_back(TitleBlock{title, subtitle});
    if (study.settings.modality == Modality::Massager)
        content.blocks.emplace_back(ParagraphBlock{
            "Modality: massager. What was felt was the vibration of a motor; levels are its strength, from 0 to 1."});
    for (const auto& back : study.goingsBack) content.blocks.emplace_back(ParagraphBlock{qtext(goingBackText(back))});
    if (parts.size() > 1) {
        content.blocks.emplace_back(
            ParagraphBlock{QString("%1%2. Each kind has its own part of this report; no figure is of both.")
                               .arg(content.simulated ? "SIMULATED: "
                                    : simulated > 0   ? "SIMULATED IN PART: "
                                                      : "",
                                    qtext(countsText(counts)))});
    } else if (const auto warning = warningOf(parts.front()); !warning.isEmpty()) {
        content.blocks.emplace_back(ParagraphBlock{warning});
    }
    return content;
}

std::vector<SessionBasis> basesOf(const std::vector<std::pair<SessionBasis, StudyRecord>>& parts) {
    std::vector<SessionBasis> all;
    for (const auto& [basis, part] : parts) all.push_back(basis);
    return all;
}

/// Adds a heading for one kind of participants if there are several kinds.
void beginPart(std::vector<ReportBlock>& blocks, Captions& captions, SessionBasis basis) {
    blocks.emplace_back(captions.heading(peopleHeading(basis)));
    if (const auto warning = warningOf(basis); !warning.isEmpty()) blocks.emplace_back(ParagraphBlock{warning});
}

/// Adds a heading, and below it what `add` adds; where no session was held a sentence says so.
template <class Add>
void addOfSessions(std::vector<ReportBlock>& blocks, Captions& captions, const QString& heading,
                   const StudyRecord& study, Add add) {
    blocks.emplace_back(captions.heading(heading));
    if (std::ranges::all_of(study.participants, [](const auto& each) { return each.sessions.empty(); }))
        blocks.emplace_back(ParagraphBlock{"No session was held."});
    else
        add();
}

void addTogether(std::vector<ReportBlock>& blocks, Captions& captions, SessionBasis basis,
                 std::vector<PersonResult> people) {
    blocks.emplace_back(captions.heading("All participants"));
    auto together = judgeFewPeople(std::move(people));
    together.who = peopleOf(basis);
    if (together.people.empty()) {
        blocks.emplace_back(ParagraphBlock{qtext(fewPeopleSentence(together))});
        return;
    }
    TableBlock table;
    table.caption = captions.table("Each participant's first session with test trials, else the last");
    table.columns = {{"Participant"},          {"Usable range"},      {"Right", true},
                     {"Accuracy, 95 %", true}, {"p by chance", true}, {"Information, corrected, 95 % (bit)", true}};
    table.columns.push_back({"Encoding"});
    for (const auto& person : together.people) {
        const auto& figures = person.figures;
        table.rows.push_back({qtext(person.name), person.usable ? "yes" : "no",
                              QString("%1 of %2").arg(figures.hits).arg(figures.n), shareText(figures.accuracy),
                              qtext(chanceText(figures.n > 0 ? figures.pChance : kNaN)),
                              qtext(bitsText(figures.itCorrected_bits)),
                              person.encoding.empty() ? QString("–") : qtext(person.encoding)});
    }
    blocks.emplace_back(std::move(table));
    if (std::isfinite(together.accuracy.median))
        blocks.emplace_back(ParagraphBlock{QString("Median accuracy %1 %, from %2 to %3 %.")
                                               .arg(figureText(100 * together.accuracy.median, 0),
                                                    figureText(100 * together.accuracy.min, 0),
                                                    figureText(100 * together.accuracy.max, 0))});
    blocks.emplace_back(ParagraphBlock{qtext(fewPeopleSentence(together))});
    blocks.emplace_back(ParagraphBlock{
        "Answers of different people are not pooled: no proportion, p or interval is given over all trials.", true});
}

/// Adds each session in a row, and which encoding is better if anybody had two.
Result<void> addStudyFigures(std::vector<ReportBlock>& blocks, Captions& captions, SessionBasis basis,
                             const StudyRecord& study) {
    const auto found = studyFigures(basis, study);
    if (!found) return failure(found);
    const auto results = toJson(*found);
    for (const auto& table : resultTraits("study-results").tables) {
        if (table.at != "sessions" && found->encodings.pairs.empty()) continue;
        if (table.shape == ResultTable::Shape::Sentences) {
            for (const auto& sentence : results[table.at])
                blocks.emplace_back(ParagraphBlock{qtext(sentence.get<std::string>())});
        } else if (!results[table.at].empty()) {
            blocks.emplace_back(tableOf(table, results[table.at], captions.table(qtext(table.title))));
        }
    }
    return {};
}

void addApproval(std::vector<ReportBlock>& blocks, Captions& captions, const StudyRecord& study) {
    blocks.emplace_back(captions.heading("Approval and consent"));
    blocks.emplace_back(approvalFacts(study));
    blocks.emplace_back(captions.heading("What the approval covers"));
    blocks.emplace_back(procedureFacts(study));
    blocks.emplace_back(captions.heading("Particulars of the study"));
    blocks.emplace_back(particularsFacts(study));
}

/// Adds why people were not enrolled and why they left, then the logs of devices and deviations.
void addNotes(std::vector<ReportBlock>& blocks, Captions& captions, const StudyRecord& study) {
    auto reasons = reasonsTable(study, {});
    if (!reasons.rows.empty()) {
        blocks.emplace_back(captions.heading("Why people did not take part"));
        reasons.caption = captions.table("People who were not enrolled, or left");
        blocks.emplace_back(std::move(reasons));
    }
    for (const auto& kind : studyLogKinds()) {
        if (kind.lastCounts || kind.key == std::string_view(kAssessed)) continue;
        blocks.emplace_back(captions.heading(kind.heading));
        auto table = notesTable(study, kind, {});
        if (table.rows.empty()) {
            blocks.emplace_back(ParagraphBlock{"None was noted."});
            continue;
        }
        table.caption = captions.table(kind.heading);
        blocks.emplace_back(std::move(table));
    }
}

/// Returns where a text is read: "stop test, how" for "stop-test.how".
QString placeOf(const std::string& key) { return qtext(key).replace('.', ", ").replace('-', ' '); }

/// Adds every text of each approved language as it will be read; without approved words, of each that there is.
void addWords(std::vector<ReportBlock>& blocks, Captions& captions, const StudyRecord& study,
              const Result<std::vector<ParticipantWords>>& words) {
    blocks.emplace_back(captions.heading("What participants read"));
    if (!words) {
        blocks.emplace_back(ParagraphBlock{qtext("It cannot be read: " + words.error().message + ".")});
        return;
    }
    blocks.emplace_back(ParagraphBlock{
        "Every text, in the order of a session. A word in braces is filled in: a code, a name, a number."});
    auto approved = study.settings.words;
    if (approved.empty()) {
        blocks.emplace_back(ParagraphBlock{"The approval states no words; these are what there is now."});
        for (const auto& each : *words) approved.push_back({each.code(), each.version(), each.sha256()});
    }
    for (const auto& each : approved) {
        const auto found = std::ranges::find(*words, each.sha256, &ParticipantWords::sha256);
        if (found == words->end()) {
            blocks.emplace_back(
                ParagraphBlock{QString("%1 is approved, and its file is not here or was changed: no session reads it.")
                                   .arg(qtext(nameOf(each)))});
            continue;
        }
        TableBlock table;
        table.caption = captions.table(qtext(found->name()));
        table.columns = {{"Where"}, {"Text"}};
        for (const auto& [key, text] : found->all()) table.rows.push_back({placeOf(key), qtext(text)});
        blocks.emplace_back(std::move(table));
    }
}

/// Adds all results about the participants of one kind.
Result<void> addResults(std::vector<ReportBlock>& blocks, Captions& captions, SessionBasis basis,
                        const StudyRecord& study) {
    std::vector<StudyPerson> persons;
    std::vector<PersonResult> people;
    for (const auto& participant : study.participants) {
        if (participant.about.state == ParticipantState::Withdrawn) continue;
        auto person = StudyPerson::analysed(participant);
        if (!person) return failure(person);
        if (!participant.sessions.empty()) people.push_back(person->result());
        persons.push_back(std::move(*person));
    }
    for (const auto& person : persons) person.addHeadlines(blocks);
    addTogether(blocks, captions, basis, std::move(people));
    if (auto added = addStudyFigures(blocks, captions, basis, study); !added) return added;
    auto figures = peopleFigures(persons, study.settings.modality == Modality::Massager);
    if (!figures) return failure(figures);
    addFigures(blocks, captions, *figures);
    for (const auto& person : persons) {
        if (auto added = person.add(blocks, captions, study.settings.modality); !added) return added;
    }
    if (auto table = preferencesTable(study)) {
        blocks.emplace_back(captions.heading("Preferred encodings"));
        table->caption = captions.table("How many participants prefer which encoding");
        blocks.emplace_back(std::move(*table));
        blocks.emplace_back(ParagraphBlock{preferencesNote(study)});
    }
    addOfSessions(blocks, captions, "Drift and exposure", study, [&] {
        blocks.emplace_back(courseTable(study, ShownName::Code, captions.table("Drift and exposure, a row a session")));
    });
    addOfSessions(blocks, captions, "Side effects", study, [&] {
        blocks.emplace_back(sideEffectsTable(study, ShownName::Code, captions.table("Side effects, a row a session")));
    });
    blocks.emplace_back(captions.heading("Flow of participants"));
    blocks.emplace_back(flowTable(study, basis, captions.table("From enrolment to result")));
    return {};
}

/// Adds who took part, and what happened to the participants of one kind.
void addCare(std::vector<ReportBlock>& blocks, Captions& captions, SessionBasis basis, const StudyRecord& study) {
    blocks.emplace_back(captions.heading("Flow of participants"));
    blocks.emplace_back(flowTable(study, basis, captions.table("From enrolment to result")));
    addOfSessions(blocks, captions, "Sessions", study, [&] {
        blocks.emplace_back(careTable(study, captions.table("Stimulation, stops and skin, a row a session")));
        blocks.emplace_back(
            courseTable(study, ShownName::Label, captions.table("Drift and exposure, a row a session")));
        blocks.emplace_back(refusalsTable(study, captions.table("Checks that did not hold")));
    });
    addOfSessions(blocks, captions, "Side effects", study, [&] {
        blocks.emplace_back(sideEffectsTable(study, ShownName::Label, captions.table("Side effects, a row a session")));
    });
    blocks.emplace_back(captions.heading("Adverse events"));
    if (study.events.empty()) {
        blocks.emplace_back(ParagraphBlock{"None was recorded."});
    } else {
        blocks.emplace_back(eventsTable(study, captions.table("Adverse events")));
    }
}

const ParticipantRecord* withCode(const StudyRecord& study, const std::string& code) {
    for (const auto& participant : study.participants) {
        if (!participant.about.code.empty() && participant.about.code == code) return &participant;
    }
    return nullptr;
}

}  // namespace

Result<ReportContent> studyReport(const StudyRecord& study) {
    const auto parts = byBasis(study);
    auto content =
        begun(study, basesOf(parts), qtext(study.settings.title), "Pilot study  ·  for those who run it: names codes");
    auto& blocks = content.blocks;
    Captions captions;
    for (const auto& [basis, part] : parts) {
        captions.setSimulated(isSimulatedBasis(basis));
        if (parts.size() > 1) beginPart(blocks, captions, basis);
        if (auto added = addResults(blocks, captions, basis, part); !added) return failure(added);
    }
    captions.setSimulated(false);
    addApproval(blocks, captions, study);
    sharePrefixes(blocks);
    return content;
}

ReportContent committeeReport(const StudyRecord& study, const Result<std::vector<ParticipantWords>>& words) {
    const auto parts = byBasis(study);
    auto content = begun(study, basesOf(parts), qtext(study.settings.title),
                         "Report to the ethics committee  ·  names no participant");
    auto& blocks = content.blocks;
    Captions captions;
    addApproval(blocks, captions, study);
    for (const auto& [basis, part] : parts) {
        captions.setSimulated(isSimulatedBasis(basis));
        if (parts.size() > 1) beginPart(blocks, captions, basis);
        addCare(blocks, captions, basis, part);
    }
    captions.setSimulated(false);
    addNotes(blocks, captions, study);
    addWords(blocks, captions, study, words);
    blocks.emplace_back(SignaturesBlock{{"Principal investigator"}, {"Name", "Date", "Signature"}, {QString()}});
    sharePrefixes(blocks);
    return content;
}

Result<ReportContent> participantReport(const StudyRecord& study, const std::string& code) {
    const auto* participant = withCode(study, code);
    if (participant == nullptr) return fail(ErrorCode::NotFound, "no participant of this study has the code {}", code);
    const auto person = StudyPerson::analysed(*participant);
    if (!person) return failure(person);
    const auto sessions = person->tested();
    auto content =
        begun(study, {participant->basis}, qtext(study.settings.title), "What you felt  ·  for the participant");
    auto& blocks = content.blocks;
    const bool massager = study.settings.modality == Modality::Massager;
    blocks.emplace_back(ParagraphBlock{
        QString("Thank you for taking part. You felt four kinds of touch, made by short %1 on your skin: rough or "
                "smooth, firm or light. After each one you said which it was.")
            .arg(massager ? "vibrations" : "pulses")});
    for (const auto& one : sessions) {
        const auto& all = one.found.all;
        blocks.emplace_back(ParagraphBlock{
            QString(
                "Session %1: you were right %2 times out of %3, which is %4 %. Guessing would be right about %5 times.")
                .arg(one.session->results.number)
                .arg(all.hits)
                .arg(all.n)
                .arg(100 * all.accuracy.value, 0, 'f', 0)
                .arg(all.chance * static_cast<double>(all.n), 0, 'f', 0)});
        if (one.found.texture && one.found.pressure) {
            blocks.emplace_back(
                ParagraphBlock{QString("You told rough from smooth %1 times, and firm from light %2 times.")
                                   .arg(one.found.texture->figures.hits)
                                   .arg(one.found.pressure->figures.hits)});
        }
    }
    if (sessions.empty()) {
        blocks.emplace_back(
            ParagraphBlock{"Your sessions did not get to the part in which you name them. That happens, and it is a "
                           "result too."});
    }
    blocks.emplace_back(ParagraphBlock{
        QString("This says nothing about your health or your skill. Some people feel such %1 clearly and others do "
                "not; finding out is why the study is done. You may ask for your data to be destroyed, or stop taking "
                "part, as your consent form says.")
            .arg(massager ? "vibrations" : "pulses")});
    content.footer = "Tactoscope";
    return content;
}

}  // namespace tacto
