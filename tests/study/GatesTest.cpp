#include <limits>

#include "core/session/Digest.h"
#include "core/study/Gates.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

constexpr CalibrationDate kToday = std::chrono::year(2026) / 11 / 23;
constexpr CalibrationDate kFormSince = std::chrono::year(2026) / 11 / 1;

StudySettings approved() {
    auto settings = test::someStudy();
    settings.approval.protocolSha256 = protocolHash(settings);
    return settings;
}

Participant someone() {
    Participant participant;
    participant.code = "P-7K3D";
    participant.consents = {{"2", std::chrono::year(2026) / 11 / 20, "KL"}};
    return participant;
}

void expectRefused(const Result<void>& gate, std::string_view sentence) {
    ASSERT_FALSE(gate);
    EXPECT_EQ(gate.error().code, kGateRefused);
    EXPECT_EQ(gate.error().message, sentence);
}

TEST(Gates, AnApprovalCountsFromItsFirstToItsLastDay) {
    RecordProperty("hazard", "H11");
    const auto settings = approved();
    EXPECT_TRUE(approvalGate(settings, kToday));
    EXPECT_TRUE(approvalGate(settings, settings.approval.from));
    EXPECT_TRUE(approvalGate(settings, settings.approval.expires));
    expectRefused(
        approvalGate(settings, std::chrono::year(2026) / 10 / 31),
        "approval EC-2026-17 begins on 2026-11-01, and today is 2026-10-31; sessions can begin from that day on");
    expectRefused(
        approvalGate(settings, std::chrono::year(2027) / 11 / 1),
        "approval EC-2026-17 expired on 2027-10-31, and today is 2027-11-01; an amendment with a later day is "
        "needed");
    auto none = settings;
    none.approval.reference.clear();
    expectRefused(approvalGate(none, kToday), "the study has no approval; a committee's reference is needed");
}

TEST(Gates, AnApprovalIsForTheSettingsAndScriptsThatItWasGivenFor) {
    RecordProperty("hazard", "H11");
    auto settings = approved();
    settings.cap_mA = 14;
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused);
    settings = approved();
    settings.scripts.front().sha256[0] = 'b';
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused);
    settings = approved();
    settings.approval.committee = "EC";  // not part of the approved protocol
    settings.license = "CC-BY-4.0";
    EXPECT_TRUE(approvalGate(settings, kToday));
}

TEST(Gates, AScriptThatWasChangedNeedsAnAmendment) {
    RecordProperty("hazard", "H11");
    auto settings = approved();
    EXPECT_TRUE(scriptGate(settings, settings.scripts.front()));
    expectRefused(scriptGate(settings, {"pilot-identification", std::string(64, 'c')}),
                  "the script pilot-identification hashes to cccccccccccc…, and approval EC-2026-17 is for "
                  "aaaaaaaaaaaa…; a changed script needs an amendment");
    expectRefused(scriptGate(settings, {"live", std::string(64, 'a')}),
                  "the script live is none of those that approval EC-2026-17 names; an amendment is needed");
    settings.kind = StudyKind::Rehearsal;
    EXPECT_TRUE(scriptGate(settings, {"live", std::string(64, 'a')}));
}

TEST(Gates, WhatPeopleFeelIsWhatWasApproved) {
    RecordProperty("hazard", "H11");
    auto settings = approved();
    StudyProcedure now;
    now.intervalMax_s = 3;
    EXPECT_TRUE(procedureGate(settings, now)) << "an approval of before it was kept names none";
    settings.procedure = {0.5, 2, DetectionMethod::Quest, std::string(64, 'a')};
    EXPECT_TRUE(procedureGate(settings, *settings.procedure));
    expectRefused(
        procedureGate(settings, {0.4, 2, DetectionMethod::Quest, std::string(64, 'a')}),
        "the profile's shortest interval is 0.4 s, and approval EC-2026-17 is for 0.5 s; a change needs an amendment");
    expectRefused(
        procedureGate(settings, {0.5, 3, DetectionMethod::Quest, std::string(64, 'a')}),
        "the profile's longest interval is 3 s, and approval EC-2026-17 is for 2 s; a change needs an amendment");
    expectRefused(procedureGate(settings, {0.5, 2, DetectionMethod::Staircase, std::string(64, 'a')}),
                  "the method of detection is staircase, and approval EC-2026-17 is for quest; a change needs an "
                  "amendment");
    expectRefused(procedureGate(settings, {0.5, 2, DetectionMethod::Quest, std::string(64, 'b')}),
                  "the profile's conditions, assignment, polarity, load range and ceilings hash to bbbbbbbbbbbb…, and "
                  "approval EC-2026-17 is for aaaaaaaaaaaa…; a change needs an amendment");
    now = *settings.procedure;
    now.comparison = true;
    expectRefused(procedureGate(settings, now),
                  "the Weber fraction of strength is measured, and approval EC-2026-17 is for not measured; a change "
                  "needs an amendment");
    now = *settings.procedure;
    now.intervalMin_s = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(procedureGate(settings, now));
    settings.kind = StudyKind::Rehearsal;
    EXPECT_TRUE(procedureGate(settings, now));
}

TEST(Gates, AnApprovalIsForItsProcedureAndOldOnesKeepTheirHash) {
    RecordProperty("hazard", "H11");
    auto settings = approved();
    auto stored = studyFields().write(settings);
    for (const char* key : {"id", "approval", "license", "procedure", "pain_ceiling", "age_min", "exclusions", "words"})
        stored.erase(key);
    EXPECT_EQ(protocolHash(settings), sha256Hex(stored.dump())) << "as before there was one";
    settings.procedure.emplace();
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused);
    settings.approval.protocolSha256 = protocolHash(settings);
    EXPECT_TRUE(approvalGate(settings, kToday));
    settings.procedure->intervalMax_s = 3;
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused);
    settings.procedure->intervalMax_s = 2;
    EXPECT_TRUE(approvalGate(settings, kToday));
    settings.words = {{"de", "1", std::string(64, 'a')}};
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused) << "what participants read is approved too";
    settings.words.clear();
    settings.procedure.reset();
    EXPECT_EQ(approvalGate(settings, kToday).error().code, kGateRefused) << "it cannot be taken out of the file";
}

TEST(Gates, OnlyAnActiveParticipantTakesPartAndNoMoreOftenThanApproved) {
    RecordProperty("hazard", "H11");
    const auto settings = approved();
    auto participant = someone();
    participant.sessions = 3;
    EXPECT_TRUE(participantGate(settings, participant));
    participant.sessions = 4;
    expectRefused(participantGate(settings, participant),
                  "P-7K3D has had 4 sessions, and approval EC-2026-17 allows 4; a further one needs an amendment");
    participant.sessions = 0;
    participant.state = ParticipantState::Left;
    expectRefused(participantGate(settings, participant),
                  "P-7K3D has left the study; only an active participant takes part");
}

TEST(Gates, SessionsLieFarEnoughApart) {
    RecordProperty("hazard", "H12");
    auto settings = approved();
    const std::chrono::sys_seconds last{std::chrono::hours(400'000)};
    EXPECT_TRUE(gapGate(settings, std::nullopt, last));
    EXPECT_TRUE(gapGate(settings, last, last + std::chrono::hours(20)));
    expectRefused(gapGate(settings, last, last + std::chrono::minutes(19 * 60 + 30)),
                  "the last session's first train was 19.5 h ago; at least 20 h must lie between two sessions");
    settings.kind = StudyKind::Rehearsal;
    EXPECT_TRUE(gapGate(settings, last, last));
}

TEST(Gates, ConsentIsToTheVersionInForceDatedAndTakenBySomeone) {
    RecordProperty("hazard", "H11");
    const auto settings = approved();
    auto participant = someone();
    EXPECT_TRUE(consentGate(settings, participant, kFormSince, kToday));
    participant.consents.front().version = "1";
    expectRefused(consentGate(settings, participant, kFormSince, kToday),
                  "P-7K3D has consented to version 1, and version 2 is in force; consent to it is needed");
    participant.consents.clear();
    expectRefused(consentGate(settings, participant, kFormSince, kToday),
                  "P-7K3D has given no consent; a dated consent to version 2 is needed");
    participant.consents = {{"2", std::chrono::year(2026) / 11 / 24, "KL"}};
    EXPECT_EQ(consentGate(settings, participant, kFormSince, kToday).error().code, kGateRefused);
    participant.consents = {{"2", kToday, ""}};
    EXPECT_EQ(consentGate(settings, participant, kFormSince, kToday).error().code, kGateRefused);
    participant.consents = {{"2", std::chrono::year(2026) / 10 / 31, "KL"}};
    expectRefused(consentGate(settings, participant, kFormSince, kToday),
                  "the consent of P-7K3D is dated 2026-10-31 and taken by \"KL\"; initials and a day from 2026-11-01, "
                  "from which version 2 of the form is approved, to 2026-11-23 are needed");
    participant.consents.push_back({"2", kFormSince, "KL"});
    EXPECT_TRUE(consentGate(settings, participant, kFormSince, kToday)) << "one that counts is enough";
}

TEST(Gates, AfterALedgerWentBackNoSessionBeginsThatDayNorWithinTheGap) {
    RecordProperty("hazard", "H11");
    auto settings = approved();
    const std::chrono::sys_seconds at = std::chrono::sys_days(kToday) + std::chrono::hours(12);
    StudyGoingBack back;
    back.at = at;
    const std::vector<StudyGoingBack> once{back};
    using namespace std::chrono_literals;
    EXPECT_TRUE(wentBackGate(settings, {}, at));
    expectRefused(wentBackGate(settings, once, at + 19h),
                  "the ledger went back 19.0 h ago, and what it lost may be a session of today; the next begins on a "
                  "later day, at least 20 h after it");
    EXPECT_TRUE(wentBackGate(settings, once, at + 20h));
    settings.gapMin_h = 0;
    EXPECT_FALSE(wentBackGate(settings, once, at + 11h)) << "the same day";
    EXPECT_TRUE(wentBackGate(settings, once, at + 12h));
    EXPECT_FALSE(wentBackGate(settings, once, at - 24h)) << "a clock that is behind";
    // The clock was set back by two days; the newest known row shows the real time.
    settings.gapMin_h = 20;
    back.at = at - 48h;
    back.newestAt = at;
    EXPECT_FALSE(wentBackGate(settings, std::vector{back}, at + 19h));
    EXPECT_TRUE(wentBackGate(settings, std::vector{back}, at + 20h));
    back.newestAt = at + 24h * 3650;
    EXPECT_TRUE(wentBackGate(settings, std::vector{back}, at + 20h)) << "a clock that ran ahead bars none for years";
    settings.kind = StudyKind::Rehearsal;
    EXPECT_TRUE(wentBackGate(settings, once, at));
}

TEST(Gates, EveryItemOfTheChecklistIsAnsweredWithNo) {
    RecordProperty("hazard", "H12");
    EXPECT_EQ(exclusionItems().size(), 10U);
    EXPECT_TRUE(exclusionGate(nothingExcludes()));
    for (const auto& item : exclusionItems()) {
        auto answers = nothingExcludes();
        std::ranges::find(answers, item.key, &ExclusionAnswer::key)->yes = true;
        const auto gate = exclusionGate(answers);
        ASSERT_THAT(gate, test::refused(kGateRefused)) << item.key;
        // The message does not say which item was answered "yes".
        EXPECT_EQ(gate.error().message.find(item.key), std::string::npos);
        std::erase_if(answers, [&](const auto& answer) { return answer.key == item.key; });
        EXPECT_EQ(exclusionGate(answers).error().code, kGateRefused) << item.key;
    }
    EXPECT_FALSE(exclusionGate({}));
}

TEST(Gates, AClockThatWasSetBackIsFound) {
    RecordProperty("hazard", "H8");
    const std::chrono::sys_seconds last = std::chrono::sys_days(kToday) + std::chrono::hours(12);
    EXPECT_TRUE(clockGate(last, last - std::chrono::minutes(5)));
    expectRefused(clockGate(last, last - std::chrono::minutes(6)),
                  "the clock says 2026-11-23 11:54 UTC, and the ledger's last row is of 2026-11-23 12:00 UTC; set the "
                  "clock");
}

TEST(Gates, VirtualParticipantsAndPeopleKeepToTheirDevices) {
    RecordProperty("hazard", "H12");
    auto settings = approved();
    auto participant = someone();
    EXPECT_TRUE(simulationGate(settings, participant, false));
    EXPECT_FALSE(simulationGate(settings, participant, true));
    participant.virtualSeed = 7;
    EXPECT_TRUE(simulationGate(settings, participant, true));
    EXPECT_FALSE(simulationGate(settings, participant, false));
    settings.kind = StudyKind::Rehearsal;
    EXPECT_FALSE(simulationGate(settings, participant, false));
    participant.virtualSeed.reset();
    EXPECT_TRUE(simulationGate(settings, participant, true));
    expectRefused(simulationGate(settings, participant, false),
                  "P-7K3D is in a rehearsal, which no committee has approved; only simulated devices are accepted");
}

TEST(StudySettings, AreReadAsWritten) {
    auto settings = approved();
    settings.id = "0123456789abcdef";
    for (const bool withProcedure : {false, true}) {
        if (withProcedure) settings.procedure = {0.4, 3, DetectionMethod::Staircase, std::string(64, 'a'), true};
        const auto read = test::accepted(studyFields().read(studyFields().write(settings), RecordPlace{}));
        EXPECT_EQ(read, settings);
    }
}

TEST(StudySettings, AnUnknownEncodingIsRefusedAndNotTakenAsTheStandardOne) {
    RecordProperty("hazard", "H9");
    auto settings = approved();
    EXPECT_THAT(setStudyField(settings, "encodings", "standard,swaped"),
                test::refusedSaying("\"swaped\"; standard and swapped are accepted"));
    auto stored = studyFields().write(settings);
    stored["encodings"] = {"mirrored"};
    auto read = settings;
    EXPECT_FALSE(studyFields().read(stored, read, RecordPlace{})) << "in a study's file too";
}

TEST(StudySettings, OnlyTheShapeThatAPersonIsGivenIsAccepted) {
    RecordProperty("hazard", "H1");
    auto settings = approved();
    EXPECT_THAT(setStudyField(settings, "train.shape", "monophasic"),
                test::refusedSaying("\"monophasic\"; \"biphasic\" is expected"));
    EXPECT_EQ(settings.train.shape, kBiphasic);
    EXPECT_TRUE(setStudyField(settings, "train.shape", "biphasic"));
}

TEST(StudySettings, AreSetByKeyAndRefuseWhatTheyDoNotAccept) {
    auto settings = approved();
    ASSERT_TRUE(setStudyField(settings, "blocks", "3"));
    ASSERT_TRUE(setStudyField(settings, "electrode.area_cm2", "5.5"));
    ASSERT_TRUE(setStudyField(settings, "encodings", "standard,swapped"));
    ASSERT_TRUE(setStudyField(settings, "site", "forearm"));
    ASSERT_TRUE(setStudyField(settings, "blind", "false"));
    ASSERT_TRUE(setStudyField(settings, "license", "CC-BY-4.0"));
    EXPECT_EQ(settings.license, "CC-BY-4.0");
    EXPECT_EQ(settings.blocks, 3);
    EXPECT_EQ(settings.electrode.area, SquareCentimetres(5.5));
    EXPECT_EQ(settings.encodings, (std::vector<std::string>{"standard", "swapped"}));
    EXPECT_EQ(settings.site, ElectrodeSite::Forearm);
    EXPECT_FALSE(settings.blind);
    const auto before = settings;
    for (const auto& [key, value] : {std::pair{"site", "chest"},
                                     {"blocks", "0"},
                                     {"blocks", "2.5"},
                                     {"cap_ma", "16"},
                                     {"cap_ma", "nan"},
                                     {"encodings", "standard,swaped"},
                                     {"encodings", "Swapped"},
                                     {"encodings", "standard,standard"},
                                     {"encodings", ""},
                                     {"kind", "rehearsal"},
                                     {"approval.expires", "2099-01-01"},
                                     {"approval.protocol_sha256", "x"},
                                     {"procedure.method", "quest"},
                                     {"bloks", "3"},
                                     {"electrode", "5"}}) {
        EXPECT_THAT(setStudyField(settings, key, value), test::refused(ErrorCode::InvalidArgument))
            << key << "=" << value;
        EXPECT_EQ(settings, before);
    }
    settings.procedure.emplace();
    ASSERT_TRUE(setStudyField(settings, "procedure.method", "staircase"));
    EXPECT_EQ(settings.procedure->method, DetectionMethod::Staircase);
    EXPECT_FALSE(setStudyField(settings, "procedure.method", "constant stimuli"));
    EXPECT_FALSE(setStudyField(settings, "procedure.interval_max_s", "3")) << "it is the profile's";
}

}  // namespace
}  // namespace tacto
