#include <QRegularExpression>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>

#include "app/report/Report.h"
#include "app/report/StudyReport.h"
#include "app/report/StudyText.h"
#include "core/analysis/identification/IdentificationText.h"
#include "core/base/Csv.h"
#include "core/base/Random.h"
#include "core/pilot/PilotRecord.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

using test::accepted;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kLabels = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

/// A session with `right` correct answers in 80 test trials; the others got the next label as answer.
SessionRecord sessionWith(std::size_t right, int number, const std::string& encoding, double days) {
    SessionRecord session;
    session.about.id = "00000000000000a1";
    session.about.number = number;
    session.about.state = StudySessionState::Complete;
    auto& results = session.results;
    results.number = static_cast<std::size_t>(number);
    results.days = days;
    results.encoding = encoding;
    results.complete = true;
    results.labels = kLabels;
    results.low = Milliamps(4);
    results.high = Milliamps(6.5);
    results.impedance = Ohms(3400);
    results.rangeImpedance = Ohms(3100);
    results.detection = 3.1;
    results.detectionLow = 2.8;
    results.detectionHigh = 3.4;
    for (std::size_t i = 0; i < 80; ++i) {
        BidsTrial row;
        row.trial.number = i + 1;
        row.trial.block = i / 16 + 1;
        row.trial.condition = kLabels[i % 4];
        row.trial.response = kLabels[(i + (i < right ? 0 : 1)) % 4];
        results.trials.push_back(row);
    }
    return session;
}

ParticipantRecord participantWith(const std::string& code, int enrolled, std::vector<SessionRecord> sessions) {
    ParticipantRecord participant;
    participant.about.code = code;
    participant.about.enrolled = enrolled;
    participant.about.consents = {{"2", {}, "AB"}};
    participant.sessions = std::move(sessions);
    return participant;
}

StudyRecord studyOfThree() {
    StudyRecord study;
    study.settings.id = "0123456789abcdef";
    study.settings.title = "Four conditions";
    study.settings.approval.reference = "EK 2026/117";
    study.settings.consentVersion = "2";
    study.ledgerHead = std::string(64, 'c');
    study.participants = {
        participantWith("P-7K3M", 1, {sessionWith(68, 1, "standard", 0), sessionWith(56, 2, "swapped", 7)}),
        participantWith("P-AAAA", 2, {sessionWith(20, 1, "standard", 0)}), participantWith("P-BBBB", 3, {})};
    SessionRow stop;
    stop.name = row::kParticipantStop;
    SessionRow gate;
    gate.name = row::kGate;
    gate.body = {{"name", "skin break 3"}, {"holds", false}, {"said", "the skin scores 2"}};
    study.participants[1].sessions[0].rows = {stop, gate};
    study.settings.encodings = {"standard", "swapped"};
    study.amendments = {{"EK 2026/117 A1", std::chrono::sys_days(std::chrono::year(2026) / 11 / 24), {"cap_ma"}}};
    auto& first = study.participants[0].sessions[0];
    first.results.drift = {{2, 3.41, true}, {3, 3.1, false}};
    first.exposure = {.trains = 900, .stimulated_s = 450, .charge_uC = 12.5};
    study.participants[0].sessions[1].results.ratings = {{"easier", "", "swapped"},
                                                         {"more-like-touch", "", "no-difference"}};
    AdverseEvent event;
    event.what = "redness";
    event.severity = 2;
    event.relation = 5;
    event.outcome = "gone";
    study.events = {{"00000000000000a1", event}};
    return study;
}

/// Returns all text of the report, one line per piece.
std::string textOf(const ReportContent& content) {
    QStringList all = {content.documentTitle, content.header, content.footer};
    for (const auto& block : content.blocks) {
        if (const auto* title = std::get_if<TitleBlock>(&block)) all << title->title << title->subtitle;
        if (const auto* heading = std::get_if<HeadingBlock>(&block)) all << heading->text;
        if (const auto* paragraph = std::get_if<ParagraphBlock>(&block)) all << paragraph->text;
        if (const auto* facts = std::get_if<FactsBlock>(&block)) {
            for (const auto& fact : facts->facts) all << fact.name + ": " + fact.value;
        }
        if (const auto* table = std::get_if<TableBlock>(&block)) {
            all << table->caption;
            for (const auto& row : table->rows) {
                EXPECT_EQ(row.size(), static_cast<qsizetype>(table->columns.size())) << table->caption.toStdString();
                all << row.join(" | ");
            }
        }
        if (const auto* figure = std::get_if<FigureBlock>(&block)) all << figure->caption << figure->legend;
    }
    return all.join('\n').toStdString();
}

TEST(StudyReport, TheCommitteesSaysWhatTheApprovalCoversAndWhatAnAmendmentChangedOfIt) {
    auto study = studyOfThree();
    study.settings.procedure = StudyProcedure{0.5, 3, DetectionMethod::Staircase, std::string(64, 'e')};
    study.amendments.front().changed = {"procedure.interval_max_s", "cap_ma"};
    const auto text = textOf(committeeReport(study));
    EXPECT_THAT(text, HasSubstr("EK 2026/117 A1 of 2026-11-24: longest interval, highest current"));
    EXPECT_THAT(text, HasSubstr("Nerve and side: median, right"));
    EXPECT_THAT(text, HasSubstr("Train: biphasic, 1 pulse of 200 µs a phase"));
    EXPECT_THAT(text, HasSubstr("Intervals: 0.5 to 3 s from onset to onset"));
    EXPECT_THAT(text, HasSubstr("Detection: weighted staircase"));
    EXPECT_THAT(text, HasSubstr("Test: 5 blocks, each 4 times each condition and 2 times nothing"));
    study.settings.procedure.reset();
    EXPECT_THAT(textOf(committeeReport(study)), HasSubstr("not kept by this approval"));
}

TEST(StudyReport, TheCommitteeReadsEveryTextOfEachApprovedLanguageAsParticipantsWill) {
    RecordProperty("hazard", "H8");
    auto study = studyOfThree();
    auto words = ParticipantWords::builtIn();
    ASSERT_GE(words.size(), 2U);
    for (const auto& each : words) study.settings.words.push_back({each.code(), each.version(), each.sha256()});
    const auto said = textOf(committeeReport(study, words)) + "\n";
    for (const auto& each : words) {
        EXPECT_THAT(said, HasSubstr(each.language() + ", version " + each.version()));
        for (const auto& [key, text] : each.all()) EXPECT_THAT(said, HasSubstr(" | " + text + "\n")) << key;
    }
    EXPECT_THAT(said, HasSubstr("stop test, question | Let us try your STOP."));
    const auto gone = words.back();
    words.pop_back();
    const auto without = textOf(committeeReport(study, words));
    EXPECT_THAT(without, HasSubstr(gone.code() + ", version " + gone.version()));
    EXPECT_THAT(without, HasSubstr("its file is not here or was changed"));
    EXPECT_THAT(without, Not(HasSubstr(gone.text("introduction.1"))));
    study.settings.words.clear();
    EXPECT_THAT(textOf(committeeReport(study, words)), HasSubstr("The approval states no words"));
    EXPECT_THAT(textOf(committeeReport(study, invalid("words/de.json lacks break.title"))),
                HasSubstr("lacks break.title"));
}

TEST(StudyReport, NoNumberOfAnyReportIsANegativeZero) {
    RecordProperty("hazard", "H8");
    Random random(49, "numbers near zero");
    const std::regex negativeZero("[-−]0([.,]0+)?(?![0-9.,])");
    for (int i = 0; i < 2000; ++i) {
        const double tiny = -std::pow(10.0, -1 - 7 * random.uniform());
        const int decimals = int(random.below(4));
        EXPECT_EQ(figureText(tiny, decimals).contains(QRegularExpression("^-[0.]*$")), false) << tiny;
        for (const auto& text : {shareText({tiny, tiny, -tiny}), qtext(bitsText({tiny, tiny, -tiny}))})
            EXPECT_FALSE(std::regex_search(text.toStdString(), negativeZero)) << text.toStdString();
    }
    EXPECT_EQ(figureText(-0.26, 1), "-0.3") << "what is below zero says so";
    // Two encodings that do not differ, within a person and over people.
    auto study = studyOfThree();
    for (auto& one : study.participants)
        one.sessions = {sessionWith(44, 1, "standard", 0), sessionWith(44, 2, "swapped", 7)};
    const auto said = textOf(*studyReport(study));
    EXPECT_FALSE(std::regex_search(said, negativeZero)) << said;
    EXPECT_THAT(said, HasSubstr("+0 percentage points"));
}

TEST(StudyReport, StandardsItemsOfTheProgramStandInBothReports) {
    RecordProperty("hazard", "H8");
    auto study = studyOfThree();
    study.settings.exclusions = {"Have you a tattoo there?"};
    study.settings.ageMin = 18;
    for (std::size_t i = 0; i < study.participants.size(); ++i) {
        auto& about = study.participants[i].about;
        about.age = std::to_string(31 + i);
        about.sex = "female";
        if (study.participants[i].sessions.empty())
            study.participants[i].sessions.push_back(sessionWith(30, 1, "standard", 0));
        auto& part = study.participants[i].sessions.front().about.parts.emplace_back();
        part.begun = std::chrono::sys_days(std::chrono::year(2026) / 11 / std::chrono::day(20U + unsigned(i)));
    }
    study.notes.push_back({kParticulars, {}, {{"medication", "none that numbs"}, {"concurrent_task", "none"}}});
    for (const auto& said : {textOf(*studyReport(study)), textOf(committeeReport(study))}) {
        for (const auto& item : exclusionItems(study.settings)) EXPECT_THAT(said, HasSubstr(item.question));
        for (const char* fact : {"Sessions: at most 4 of each participant and of 60 min, 20 h or more apart",
                                 "Blind: the participant, and the operator until", "Orders: conditions drawn",
                                 "Levels: from zero by a step", "Sessions held: 2026-11-20 to 2026-11-22",
                                 "30-39, female, unknown: 3", "Medication of participants: none that numbs",
                                 "Task during the stimulation: none", "Sponsor: unknown", "3.400"})
            EXPECT_THAT(said, HasSubstr(fact));
        for (const auto& field : (*studyLogKind(kParticulars))->fields)
            EXPECT_THAT(said, HasSubstr(std::string(field.label) + ": "));
    }
    study.participants.back().about.sex = "male";
    EXPECT_THAT(textOf(committeeReport(study)), Not(HasSubstr("male, "))) << "of three each could be told";
}

TEST(StudyReport, WithoutASessionEachSaysSoAndNoTableIsEmpty) {
    RecordProperty("hazard", "H11");
    auto study = studyOfThree();
    for (auto& each : study.participants) each.sessions.clear();
    for (const auto& content : {accepted(studyReport(study)), committeeReport(study)}) {
        EXPECT_THAT(textOf(content), HasSubstr("No session was held."));
        EXPECT_THAT(textOf(content), Not(HasSubstr("Median accuracy")));
        for (const auto& block : content.blocks) {
            const auto* table = std::get_if<TableBlock>(&block);
            if (table != nullptr) EXPECT_FALSE(table->rows.empty()) << table->caption.toStdString();
        }
    }
    EXPECT_THAT(textOf(*studyReport(study)), HasSubstr("Nothing is known: no participant has a session"));
}

TEST(StudyReport, EachPersonsResultComesFirst) {
    const auto content = accepted(studyReport(studyOfThree()));
    const auto said = textOf(content);
    EXPECT_THAT(said, HasSubstr("P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance "
                                "25 %) between 4.0 and 6.5 mA, 12 to 20 V at 3.1 kΩ."));
    EXPECT_LT(said.find("told the four apart"), said.find("All participants"));
    EXPECT_THAT(said, HasSubstr("1 of 2 were above chance"));
    EXPECT_THAT(said, HasSubstr("swapped minus standard: -15"));
    EXPECT_THAT(said, HasSubstr("P-7K3M over sessions"));
    EXPECT_THAT(said, HasSubstr("Enrolled | 3"));
    EXPECT_THAT(said, HasSubstr("Answered test trials | 2"));
    EXPECT_FALSE(std::regex_search(said, std::regex("\\bnan\\b")));
}

TEST(StudyReport, ASessionWithoutAUsableRangeIsNotCountedAsOneAndSaysWhyThereWasNoTest) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    auto narrow = sessionWith(0, 1, "standard", 0);
    narrow.results.trials.clear();
    narrow.results.rangeNotUsable = "from the lowest level of 4.0 mA to the highest of 4.5 mA there is 1 step";
    study.participants[2].sessions = {narrow};
    auto content = studyReport(study);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_THAT(textOf(*content), HasSubstr("P-BBBB | no | 0 of 0 | – | – | –"));
    EXPECT_THAT(textOf(*content), HasSubstr("Session 1 had no usable range, and so no test: from the lowest level of"));
    EXPECT_THAT(textOf(*content), HasSubstr("Had a usable range | 2"));
    // On the first day thresholds found a range, but the test's session found none, so that session has no test.
    auto wide = narrow;
    wide.results.rangeNotUsable.clear();
    narrow.results.number = 2;
    study.participants[2].sessions = {wide, narrow};
    content = studyReport(study);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_THAT(textOf(*content), HasSubstr("P-BBBB | no | 0 of 0 | – | – | –"));
    EXPECT_THAT(textOf(*content), HasSubstr("Had a usable range | 3"));
    EXPECT_THAT(textOf(*content), HasSubstr("| 4.0 to 6.5 | "));
    EXPECT_THAT(textOf(*content), HasSubstr("2 | 0 | 3.10 (2.80 to 3.40) | – | – | "));
}

TEST(StudyReport, ThresholdsAndRatingsOverSessionsStandBesideTheFirst) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    auto thresholds = sessionWith(0, 3, "standard", 14);
    thresholds.results.trials.clear();  // a session of thresholds only
    thresholds.results.detection = 6.2;
    thresholds.results.detectionLow = 5.6;
    thresholds.results.detectionHigh = 6.8;
    thresholds.results.tooStrong = 9;
    thresholds.results.saidTooStrong = true;
    auto& sessions = study.participants[0].sessions;
    sessions.push_back(thresholds);
    sessions[0].results.tooStrong = 7.5;
    sessions[0].results.saidTooStrong = true;
    sessions[0].results.ratings = {{"intensity", "rough-low", "4"}, {"intensity", "rough-high", "7"}};
    const auto content = accepted(studyReport(study));
    const auto said = textOf(content);
    EXPECT_THAT(said, HasSubstr("1 | 0 | 3.10 (2.80 to 3.40) | 7.5 | 4.0 to 6.5 | 3400 | 68 of 80 | "));
    EXPECT_THAT(said, HasSubstr("3 | 14 | 6.20 (5.60 to 6.80) | 9.0 | 4.0 to 6.5 | 3400 | – | –"));
    // ln 2 - √(ln²(3.4/3.1) + ln²(6.2/5.6)) down, ln 2 + √(ln²(3.1/2.8) + ln²(6.8/6.2)).
    EXPECT_THAT(said, HasSubstr("3 | – | 2.00 (1.74 to 2.29) | 1.20 | 1.00 | 1.00"));
    EXPECT_THAT(said, HasSubstr("1 | 5.5 | – | – | –"));
    EXPECT_FALSE(std::regex_search(said, std::regex("\\bnan\\b")));
    // The highest level given was not called too strong, so the level that is too strong lies above.
    sessions.back().results.saidTooStrong = false;
    const auto never = textOf(studyReport(study).value());
    EXPECT_THAT(never, HasSubstr("3 | 14 | 6.20 (5.60 to 6.80) | > 9.0 | "));
    EXPECT_THAT(never, HasSubstr("3 | – | 2.00 (1.74 to 2.29) | – | 1.00 | 1.00"));
}

TEST(StudyReport, TheCommitteesClaimsNoCheckThatIsNotOnRecord) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    const auto said = [&] { return textOf(committeeReport(study)); };
    EXPECT_THAT(said(), HasSubstr("skin break 3 | the skin scores 2"));
    auto& rows = study.participants[1].sessions[0].rows;
    rows.back().body["holds"] = true;
    EXPECT_THAT(said(), HasSubstr("– | – | – | every check on record held\n"));
    study.participants[2].about.state = ParticipantState::Withdrawn;
    EXPECT_THAT(said(), HasSubstr("held; the records of participants who withdrew are destroyed"));
    rows.clear();
    EXPECT_THAT(said(), HasSubstr("no check of a session is on record"));
}

TEST(StudyReport, DriftAndExposureStandInBothReports) {
    RecordProperty("hazard", "H11");
    const auto content = accepted(studyReport(studyOfThree()));
    const auto course = "block 2: 1.10, adapted; block 3: 1.00 | 900 | 7.5 | 12.5";
    EXPECT_THAT(textOf(content), HasSubstr(std::string("P-7K3M | 1 | ") + course));
    const auto committees = textOf(committeeReport(studyOfThree()));
    EXPECT_THAT(committees, HasSubstr(std::string(" | 1 | ") + course));
    EXPECT_THAT(committees, HasSubstr("EK 2026/117 A1 of 2026-11-24: highest current"));
}

TEST(StudyReport, APredictionFromThePersonsThresholdsStandsBesideTheAnswersAndJudgesNothing) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    const auto without = textOf(*studyReport(study));
    EXPECT_THAT(without, Not(HasSubstr("predicted from"))) << "no row says what was delivered";
    auto& results = study.participants[0].sessions[0].results;
    for (auto& row : results.trials) {
        row.trial.current = Milliamps(row.trial.condition.starts_with("rough") ? 3.1 : 310);
        row.trial.interval_s = row.trial.condition.ends_with("high") ? 0.5 : 2;
    }
    const auto said = textOf(*studyReport(study));
    EXPECT_THAT(said, HasSubstr("P-7K3M, session 1: predicted from the detection threshold, and answered"));
    // At the threshold, the noise of 1 JND hides one presentation in two. Far above the threshold, intervals (9.3 JND
    // apart) and levels are never confused.
    EXPECT_THAT(said, HasSubstr("rough-low | 0 % | 0 % | 50 % | 0 % | 50 % | 50 % | "));
    EXPECT_THAT(said, HasSubstr("smooth-high | 0 % | 100 % | 0 % | 0 % | 0 % | 100 % | "));
    EXPECT_THAT(said,
                HasSubstr("it expects 75 % at 0.05, 75 % at 0.10, 75 % at 0.20 as the Weber fraction of amplitude, "
                          "which is not known of this person"));
    auto compared = sessionWith(0, 3, "standard", 14);
    compared.results.trials.clear();
    compared.results.amplitudeWeber = 0.37;
    study.participants[0].sessions.push_back(compared);
    EXPECT_THAT(textOf(*studyReport(study)), HasSubstr("75 % at 0.37 as the Weber fraction of amplitude, of which the "
                                                       "last was measured and stands in the table"));
}

TEST(StudyReport, SideEffectsOfTheNextDayAreShownOrCalledNotAsked) {
    RecordProperty("hazard", "H12");
    auto study = studyOfThree();
    auto& results = study.participants[0].sessions[0].results;
    results.sideEffectsAsked = {"before", "next day"};
    results.sideEffects = {{"next day", "redness", 2, 4}};
    results.skinNextDay = 1;
    const auto content = accepted(studyReport(study));
    const auto row = " | 1 | nothing | not asked | redness (2 mild; relation 4 probable) | 1";
    EXPECT_THAT(textOf(content), HasSubstr(std::string("P-7K3M") + row));
    EXPECT_THAT(textOf(content), HasSubstr("P-7K3M | 2 | not asked | not asked | not asked | not asked"));
    EXPECT_THAT(textOf(committeeReport(study)), HasSubstr(row));
}

TEST(StudyReport, AnAdverseEventIsReportedInTheWordsInWhichItIsNoted) {
    RecordProperty("hazard", "H12");
    auto study = studyOfThree();
    study.events[0].second.severity = 4;
    study.events[0].second.relation = 3;
    EXPECT_THAT(textOf(committeeReport(study)), HasSubstr("redness | 4 life-threatening | no | 3 possible | "));
}

TEST(StudyReport, TheCommitteesSaysWhatStandardsAskAndUnknownWhereNothingIsKnown) {
    RecordProperty("hazard", "H11");
    auto study = studyOfThree();
    const auto said = [&] { return textOf(committeeReport(study)); };
    EXPECT_THAT(said(), HasSubstr("Objectives: unknown"));
    EXPECT_THAT(said(), HasSubstr("Electrode that leads: unknown"));
    EXPECT_THAT(said(), HasSubstr("Device deficiencies\nNone was noted."));
    EXPECT_THAT(said(), Not(HasSubstr("Assessed")));
    study.notes = {{kParticulars, {}, {{"objectives", "to find the range"}, {"leading_electrode", "distal"}}},
                   {kParticulars, {}, {{"leading_electrode", "proximal"}}},
                   {kAssessed, {}, {{"reason", "declined"}, {"more", ""}}},
                   {kAssessed, {}, {{"reason", "declined"}}},
                   {"deficiency", {}, {{"serial", "P24-7"}, {"what", "a loose plug"}, {"reported", "yes"}}}};
    study.participants[0].about.state = ParticipantState::Left;
    auto& event = study.events[0].second;
    event.serious = true;
    event.onset = "2026-11-22";
    event.expected = Expectedness::Unexpected;
    EXPECT_THAT(said(), HasSubstr("Objectives: to find the range"));
    EXPECT_THAT(said(), HasSubstr("Electrode that leads: proximal"));
    EXPECT_THAT(said(), HasSubstr("Assessed | 5\nEnrolled | 3"));
    EXPECT_THAT(said(), HasSubstr("Assessed and not enrolled | declined | 2"));
    EXPECT_THAT(said(), HasSubstr("Left | unknown | 1"));
    EXPECT_THAT(said(), HasSubstr("1970-01-01 | P24-7 | a loose plug | unknown | unknown | unknown | yes"));
    EXPECT_THAT(said(), HasSubstr("| yes; holds the study | 5 definite | unexpected | 2026-11-22, unknown | "));
    event.releasedBy = "K. Lang";
    EXPECT_THAT(said(), HasSubstr("yes; released by K. Lang"));
    study.settings.modality = Modality::Massager;
    EXPECT_THAT(said(), Not(HasSubstr("Electrode that leads")));
}

TEST(StudyReport, PreferencesAreShownWithTheirOrderAndNotTested) {
    RecordProperty("hazard", "H9");
    const auto content = accepted(studyReport(studyOfThree()));
    const auto said = textOf(content);
    EXPECT_THAT(said, HasSubstr("Easier to tell: swapped. More like touch: no difference."));
    for (const char* row : {"standard | 0 | 0", "swapped | 1 | 0", "no difference | 0 | 1"})
        EXPECT_THAT(said, HasSubstr(row));
    EXPECT_THAT(said, HasSubstr("five alike of five people have p = 0.06 (two-sided). In the order in which they had "
                                "the encodings: 1 participant(s) had standard, swapped. The orders are not balanced"));
    EXPECT_THAT(textOf(committeeReport(studyOfThree())), Not(HasSubstr("Easier")));
    auto unrated = studyOfThree();
    unrated.participants[0].sessions[1].results.ratings.clear();
    EXPECT_THAT(textOf(*studyReport(unrated)), Not(HasSubstr("Preferences are shown")));
}

TEST(StudyReport, TheCommitteesNamesNoCodeAndNoAnswer) {
    RecordProperty("hazard", "H11");
    const auto said = textOf(committeeReport(studyOfThree()));
    EXPECT_THAT(said, Not(HasSubstr("P-7K3M")));
    EXPECT_THAT(said, Not(HasSubstr("P-AAAA")));
    EXPECT_THAT(said, Not(HasSubstr("85 %")));
    EXPECT_THAT(said, HasSubstr("EK 2026/117"));
    EXPECT_THAT(said, HasSubstr("version 2: 3 people"));
    EXPECT_THAT(said, HasSubstr("the skin scores 2"));
    EXPECT_THAT(said, HasSubstr("redness | 2 moderate | no | 5 definite"));
    EXPECT_THAT(said, HasSubstr("Enrolled | 3"));
}

TEST(StudyReport, TheParticipantsIsPlainAndNamesNoOtherPerson) {
    RecordProperty("hazard", "H11");
    const auto content = accepted(participantReport(studyOfThree(), "P-7K3M"));
    const auto said = textOf(content);
    EXPECT_THAT(said, HasSubstr("Session 1: you were right 68 times out of 80, which is 85 %. Guessing would be right "
                                "about 20 times."));
    EXPECT_THAT(said, Not(HasSubstr("P-")));
    EXPECT_THAT(said, Not(HasSubstr("0123456789abcdef")));
    EXPECT_EQ(participantReport(studyOfThree(), "P-ZZZZ").error().message,
              "no participant of this study has the code P-ZZZZ");
}

TEST(StudyReport, SimulatedParticipantsAreCalledSo) {
    RecordProperty("hazard", "H9");
    auto study = studyOfThree();
    study.rehearsal = true;
    for (auto& participant : study.participants) participant.basis = SessionBasis::Virtual;
    const auto content = studyReport(study);
    ASSERT_TRUE(content);
    EXPECT_TRUE(content->simulated);
    EXPECT_THAT(textOf(*content), HasSubstr("SIMULATED"));
}

/// A study of persons, persons on simulated devices and virtual participants in random order; with or without sessions
/// and consent, some no longer in the study. The codes say which is which: P-P…, P-S…, P-V….
StudyRecord mixedStudy(Random& random) {
    auto study = studyOfThree();
    study.participants.clear();
    study.events.clear();
    const auto all = 1 + random.below(9);
    for (std::size_t i = 1; i <= all; ++i) {
        const auto basis = kSessionBases[random.below(3)].value;
        std::vector<SessionRecord> sessions;
        const auto count = random.below(3);
        for (std::size_t number = 1; number <= count; ++number) {
            sessions.push_back(sessionWith(20 + random.below(60), int(number), number == 1 ? "standard" : "swapped",
                                           double(7 * number)));
            sessions.back().about.id = fmt::format("{:016x}", 16 * i + number);
            sessions.back().about.basis = sessions.back().results.basis = basis;
            study.bases.emplace(sessions.back().about.id, basis);
            AdverseEvent event;
            event.what = fmt::format("event of {}", "PSV"[std::size_t(basis)]);
            study.events.emplace_back(sessions.back().about.id, event);
        }
        auto one = participantWith(fmt::format("P-{}{:03}", "PSV"[std::size_t(basis)], i), int(i), sessions);
        one.basis = basis;
        if (random.below(3) == 0) one.about.consents.clear();
        if (random.below(4) == 0) one.about.state = ParticipantState::Left;
        if (basis == SessionBasis::Virtual) one.about.virtualSeed = i;
        study.participants.push_back(one);
    }
    return study;
}

/// Returns the kinds of participants that a text names, by the codes and events of mixedStudy().
std::set<char> kindsIn(const std::string& text) {
    std::set<char> all;
    static const std::regex named("P-([PSV])\\d{3}|event of ([PSV])");
    for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at)
        all.insert(((*at)[1].matched ? (*at)[1] : (*at)[2]).str().front());
    return all;
}

TEST(StudyReport, NoFigureOrTableIsOfPeopleAndOfSimulatedOnesTogether) {
    RecordProperty("hazard", "H8");
    Random random(1847, "mixed studies");
    for (int trial = 0; trial < test::trials<int>({.local = 40, .ci = 200, .campaign = 2000}); ++trial) {
        const auto study = mixedStudy(random);
        std::map<char, std::size_t> enrolled, consented, begun;
        for (const auto& one : study.participants) {
            const char kind = one.about.code.at(2);
            ++enrolled[kind];
            consented[kind] += one.about.consents.empty() ? 0 : 1;
            begun[kind] += one.sessions.empty() ? 0 : 1;
        }
        const auto whole = accepted(studyReport(study));
        const auto committee = committeeReport(study);
        for (const auto* content : {&whole, &committee}) {
            SCOPED_TRACE(textOf(*content));
            const bool any = std::ranges::any_of(begun, [](const auto& each) { return each.second > 0; });
            EXPECT_EQ(content->simulated, (any ? begun : enrolled)['P'] == 0) << "who waits took no part";
            EXPECT_EQ(textOf(*content).find("SIMULATED") != std::string::npos, enrolled.size() > enrolled.count('P'));
            for (const auto& block : content->blocks) {
                const auto* table = std::get_if<TableBlock>(&block);
                const auto* said = std::get_if<ParagraphBlock>(&block);
                const auto* figure = std::get_if<FigureBlock>(&block);
                auto text = (table != nullptr    ? table->caption
                             : said != nullptr   ? said->text
                             : figure != nullptr ? figure->caption
                                                 : QString())
                                .toStdString();
                for (const auto& row : table != nullptr ? table->rows : std::vector<QStringList>())
                    text += '\n' + row.join(" | ").toStdString();
                const auto kinds = kindsIn(text);
                ASSERT_LE(kinds.size(), 1U) << text;
                if (kinds.empty()) continue;
                EXPECT_EQ(kinds.contains('V'), text.find("(virtual)") != std::string::npos) << text;
                EXPECT_EQ(kinds.contains('S'), text.find("(simulated devices)") != std::string::npos) << text;
                if (table == nullptr && figure == nullptr) continue;
                const bool marked = text.find("(simulated)") != std::string::npos;
                EXPECT_EQ(marked, !kinds.contains('P')) << text;
            }
            // Each kind of participant has its own flow chart, named in the heading of its column.
            std::map<std::string, std::size_t> shown;
            for (const auto& block : content->blocks) {
                const auto* table = std::get_if<TableBlock>(&block);
                if (table == nullptr || table->columns.front().title != "Step") continue;
                const auto who = table->columns.at(1).title;
                const char kind = who == "People" ? 'P' : who == "Virtual participants" ? 'V' : 'S';
                EXPECT_EQ(table->rows.at(0).at(1).toULong(), enrolled[kind]) << who.toStdString();
                EXPECT_EQ(table->rows.at(1).at(1).toULong(), consented[kind]) << who.toStdString();
                EXPECT_EQ(table->rows.at(2).at(1).toULong(), begun[kind]) << who.toStdString();
                ++shown[who.toStdString()];
            }
            std::size_t kinds = 0;
            for (const auto& [kind, n] : enrolled) kinds += n > 0 ? 1 : 0;
            EXPECT_EQ(shown.size(), kinds);
        }
        const auto said = textOf(whole);
        EXPECT_EQ(said.find("of such people can") != std::string::npos, begun['P'] > 0) << said;
        EXPECT_EQ(said.find("of such virtual participants can") != std::string::npos, begun['V'] > 0) << said;
        for (const auto& one : study.participants) {
            const auto own = accepted(participantReport(study, one.about.code));
            EXPECT_EQ(own.simulated, one.about.code.at(2) != 'P') << one.about.code;
        }
    }
}

TEST(StudyReport, AStudyWithoutSessionsHasAReportToo) {
    const auto content = accepted(studyReport(StudyRecord()));
    EXPECT_THAT(textOf(content), HasSubstr("Nothing is known: no participant has a session with test trials."));
}

TEST(StudyReport, IsWrittenAsPdfAndHtml) {
    const test::ScratchDir folder;
    for (const char* name : {"r.pdf", "r.html"}) {
        const auto path = folder.path() / name;
        accepted(writeContent(*studyReport(studyOfThree()), QString::fromStdString(path.string())));
        EXPECT_GT(std::filesystem::file_size(path), 5000U);
    }
    const auto html = readTextFile(folder.path() / "r.html").value_or("");
    EXPECT_THAT(html, HasSubstr("told the four apart in 68 of 80 trials"));
}

std::string textOfAll(const ReportContent& content) {
    std::string all;
    const auto add = [&all](const QString& text) { all += text.toStdString() + '\n'; };
    for (const auto& block : content.blocks) {
        if (const auto* paragraph = std::get_if<ParagraphBlock>(&block)) add(paragraph->text);
        if (const auto* facts = std::get_if<FactsBlock>(&block)) {
            for (const auto& fact : facts->facts) add(fact.name + ": " + fact.value);
        }
        const auto* table = std::get_if<TableBlock>(&block);
        if (table == nullptr) continue;
        add(table->caption);
        for (const auto& column : table->columns) add(column.title);
        for (const auto& row : table->rows) add(row.join(" | "));
    }
    return all;
}

/// The study of three with a massager; the first participant had an accelerometer on the motor.
StudyRecord vibratedStudy() {
    auto study = studyOfThree();
    study.settings.modality = Modality::Massager;
    for (auto& participant : study.participants) {
        for (auto& session : participant.sessions) {
            auto& results = session.results;
            results.low = results.high = Milliamps(kNaN);
            results.impedance = Ohms(kNaN);
            results.lowIntensity = 0.3;
            results.highIntensity = 0.55;
            results.detection = 0.22;
            results.tooStrong = 0.7;
            for (auto& row : results.trials) {
                row.intensity = row.trial.condition.starts_with("rough") ? 0.55 : 0.3;
                row.trial.interval_s = row.trial.condition.ends_with("high") ? 0.5 : 2;
            }
        }
    }
    for (auto& row : study.participants[0].sessions[0].results.trials) {
        auto& did = row.vibration;
        did.bursts = did.moved = 3;
        did.strength_m_s2 = 10 * row.intensity * row.intensity * (1 + 0.01 * static_cast<double>(row.trial.number % 3));
        did.interval_s = row.trial.interval_s * (1 + 0.001 * static_cast<double>(row.trial.number % 5));
        did.latency_s = 0.012;
        did.rise_s = 0.06;
        did.strengthUncertainty_m_s2 = 0.001;
        did.intervalUncertainty_s = 1e-4;
    }
    return study;
}

TEST(StudyReport, WithAMassagerSaysStrengthAndNeverCurrentOrVoltage) {
    RecordProperty("hazard", "H9");
    const auto study = vibratedStudy();
    for (const auto& text : {textOfAll(studyReport(study).value()), textOfAll(committeeReport(study)),
                             textOfAll(participantReport(study, "P-7K3M").value())}) {
        for (const char* electrical : {"mA", "Ω", " V ", "µC", "pulse", "urrent", "electrode"})
            EXPECT_THAT(text, Not(HasSubstr(electrical)));
        EXPECT_THAT(text, HasSubstr("massager"));
    }
    const auto all = textOfAll(studyReport(study).value());
    EXPECT_THAT(all, HasSubstr("between strengths of 0.30 and 0.55"));
    EXPECT_THAT(all, HasSubstr("Too strong (strength)"));
    EXPECT_THAT(all, HasSubstr("0.30 to 0.55"));
}

TEST(StudyReport, AColumnHasOnePrefixOfAUnitAndNoDeviationAfterPlusMinus) {
    RecordProperty("hazard", "H8");
    const std::regex unit("^[−±≤ ]*[0-9.]+ ([pnµmkM]?)(V|A|s|Ω|N)\\b");
    std::vector<ReportContent> all;
    all.push_back(studyReport(studyOfThree()).value());
    all.push_back(studyReport(vibratedStudy()).value());
    all.push_back(committeeReport(studyOfThree()));
    for (const auto& content : all) {
        for (const auto& block : content.blocks) {
            const auto* table = std::get_if<TableBlock>(&block);
            if (table == nullptr) continue;
            for (std::size_t c = 0; c < table->columns.size(); ++c) {
                std::map<std::string, std::set<std::string>> met;
                for (const auto& row : table->rows) {
                    const auto cell = QString(row.value(qsizetype(c))).replace(QChar(0x202f), ' ').toStdString();
                    std::smatch found;
                    if (std::regex_search(cell, found, unit)) met[found[2]].insert(found[1]);
                    EXPECT_THAT(cell, Not(HasSubstr("± s.d.")));
                }
                for (const auto& [base, prefixes] : met)
                    EXPECT_EQ(prefixes.size(), 1U)
                        << table->caption.toStdString() << ", " << table->columns[c].title.toStdString();
            }
        }
    }
}

TEST(StudyReport, SaysWhatTheMotorDidOrThatItWasNotMeasured) {
    RecordProperty("hazard", "H9");
    const auto all = textOfAll(studyReport(vibratedStudy()).value());
    EXPECT_THAT(all, HasSubstr("P-7K3M, session 1: what the motor did"));
    EXPECT_THAT(all, HasSubstr("60 of 60 vibrations"));
    EXPECT_THAT(all, HasSubstr("by the rule that electrical conditions are judged by: pass."));
    EXPECT_THAT(all, HasSubstr("What the massager did: Not measured"));
    EXPECT_THAT(textOfAll(studyReport(studyOfThree()).value()), Not(HasSubstr("massager did")));
}

}  // namespace
}  // namespace tacto
