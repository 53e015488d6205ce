// The participants of a study: enrolment, consent, the day after, leaving and withdrawal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/study/NextDay.h"
#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using Desk = test::StudyDesk;

TEST_F(Desk, AWithdrawnParticipantLeavesNothingThatOpens) {
    RecordProperty("hazard", "H11");
    std::string code, file;
    std::shared_ptr<const RowSeal> none;
    std::filesystem::path path;
    {
        auto study = make();
        code = enrolled(study, 1);
        const auto stays = enrolled(study, 2);
        const auto begun = study.beginSession(test::someRequest(code)).value();
        path = begun.path;
        file = begun.session.id;
        ASSERT_TRUE(study.endSession(file, StudySessionState::Complete, record(begun)));
        ASSERT_TRUE(study.withdraw(code));
        EXPECT_EQ(study.find(code).error().code, ErrorCode::NotFound);
        EXPECT_TRUE(study.find(stays));
    }
    auto study = test::accepted(open());
    EXPECT_EQ(study.find(code).error().code, ErrorCode::NotFound);
    EXPECT_EQ(study.sealOf(file).error().code, ErrorCode::Unsupported);
    EXPECT_FALSE(study.events(study.sessions()[0]));
    const auto gone = study.participants()[0];
    EXPECT_EQ(gone.state, ParticipantState::Withdrawn);
    EXPECT_EQ(gone.sessions, 1);
    EXPECT_EQ(gone.code, "");
    EXPECT_TRUE(gone.consents.empty());
    EXPECT_TRUE(SessionReader::open(path)->locked());
    EXPECT_TRUE(study.stillApproved());  // the hash chains stay whole
    EXPECT_EQ(everythingBelow(scratch.path() / "home").find(code), std::string::npos);
}

TEST_F(Desk, ASessionSaysOnWhomAndWhatItRestsForAsLongAsThereIsALedger) {
    RecordProperty("hazard", "H8");
    std::string gone;
    {
        auto study = make();
        const auto code = enrolled(study, 1);
        gone = enrolled(study, 2);
        auto asPerson = test::someRequest(code);
        asPerson.personAnswers = true;
        EXPECT_THAT(study.beginSession(asPerson).error().message,
                    testing::HasSubstr("is a virtual participant and answers by itself"));
        const auto begun = study.beginSession(test::someRequest(code)).value();
        EXPECT_EQ(begun.session.basis, SessionBasis::Virtual);
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
        Participant person;
        const auto other = study.enrol(person).value();
        EXPECT_EQ(study.basisOf(other), SessionBasis::Person) << "also without consent or session";
        ASSERT_TRUE(study.withdraw(code));
        ASSERT_TRUE(study.withdraw(gone));
    }
    const auto sealed = test::accepted(openWithoutKey());
    EXPECT_EQ(sealed.sessions().at(0).basis, SessionBasis::Virtual);
    const auto study = test::accepted(open());
    EXPECT_EQ(study.basisOf(study.participants().at(0)), SessionBasis::Virtual);
    EXPECT_EQ(study.basisOf(study.participants().at(1)), SessionBasis::Virtual) << "withdrawn without a session";
}

TEST_F(Desk, APersonAndAVirtualParticipantAreNeverOneParticipantOfARehearsal) {
    RecordProperty("hazard", "H8");
    auto study = Study::createRehearsal(folder(), {}, around()).value();
    for (const bool personFirst : {true, false}) {
        Participant made;
        made.virtualSeed = personFirst ? 1 : 2;
        const auto code = study.enrol(made).value().code;
        ASSERT_TRUE(study.consent(code, {study.settings().consentVersion, study.today(), "KL"}));
        auto request = test::someRequest(code);
        request.personAnswers = personFirst;
        const auto begun = study.beginSession(request).value();
        EXPECT_EQ(begun.session.basis, personFirst ? SessionBasis::PersonSimulated : SessionBasis::Virtual);
        const auto chain = record(begun);
        request.personAnswers = !personFirst;
        const auto resumed = study.continueSession(begun.session.id, request);
        ASSERT_FALSE(resumed);
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, chain));
        const auto refused = study.beginSession(request);
        ASSERT_FALSE(refused);
        for (const auto& why : {resumed.error(), refused.error()}) {
            EXPECT_EQ(why.code, kGateRefused);
            EXPECT_THAT(why.message, testing::HasSubstr("another seed, is expected"));
        }
        request.personAnswers = personFirst;
        EXPECT_TRUE(study.beginSession(request));
    }
}

using WithDesk = test::WithPerson<Desk>;

TEST_F(WithDesk, WhoLeavesKeepsTheirData) {
    RecordProperty("hazard", "H11");
    ASSERT_TRUE(study.leave(code));
    EXPECT_EQ(study.find(code)->state, ParticipantState::Left);
    EXPECT_EQ(study.leave(code).error().code, kGateRefused);
    EXPECT_EQ(study.consent(code, {"2", study.today(), "KL"}).error().code, kGateRefused);
    EXPECT_TRUE(study.withdraw(code));
}

TEST_F(Desk, AStudyThatKeepsDataRefusesAWithdrawal) {
    auto settings = test::someStudy();
    settings.dataOnRequest = DataOnRequest::Keep;
    auto study = make(settings);
    const auto code = enrolled(study);
    EXPECT_EQ(study.withdraw(code).error().code, kGateRefused);
    EXPECT_TRUE(study.find(code));
}

TEST_F(Desk, AnAmendmentTakesNoPromiseBackThatWasConsentedTo) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto earlier = enrolled(study, 1);
    auto keeps = study.settings();
    keeps.dataOnRequest = DataOnRequest::Keep;
    ASSERT_TRUE(study.amend(keeps, "EC-2026-17 A1"));
    const auto later = enrolled(study, 2);
    const auto reconsented = enrolled(study, 3);
    EXPECT_EQ(study.withdraw(later).error().code, kGateRefused);
    EXPECT_TRUE(study.withdraw(earlier)) << "their form said that it is destroyed";
    auto destroys = study.settings();
    destroys.dataOnRequest = DataOnRequest::Destroy;
    ASSERT_TRUE(study.amend(destroys, "EC-2026-17 A2"));
    ASSERT_TRUE(study.consent(reconsented, {"2", study.today(), "KL"}));
    ASSERT_TRUE(study.amend(keeps, "EC-2026-17 A3"));
    EXPECT_EQ(study.withdraw(later).error().code, kGateRefused);
    EXPECT_TRUE(study.withdraw(reconsented));
}

TEST_F(Desk, NoMoreParticipantsThanApproved) {
    RecordProperty("hazard", "H11");
    auto settings = test::someStudy();
    settings.participantsMax = 2;
    auto study = make(settings);
    enrolled(study, 1);
    const auto code = enrolled(study, 2);
    EXPECT_EQ(study.enrol({}).error().code, kGateRefused);
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_EQ(study.enrol({}).error().code, kGateRefused);  // nobody may take the place of a person who took part
}

TEST_F(Desk, ACodeAndASeedAreEnrolledOnce) {
    auto study = make();
    Participant named;
    named.code = "p-7k3d";
    EXPECT_EQ(study.enrol(named)->code, "P-7K3D");
    EXPECT_EQ(study.enrol(named).error().code, ErrorCode::Unsupported);
    named.code = "P-7K3M";
    EXPECT_EQ(study.enrol(named).error().code, ErrorCode::NotFound);
    enrolled(study, 5);
    Participant twin;
    twin.virtualSeed = 5;
    EXPECT_EQ(study.enrol(twin).error().code, ErrorCode::Unsupported);
    for (const char* same : {"P7K3D", "P-7-K3D", "p7k3-d"}) {  // the same code with other hyphens is the same person
        named.code = same;
        EXPECT_EQ(study.enrol(named).error().code, ErrorCode::Unsupported) << same;
    }
    EXPECT_EQ(study.participants().size(), 2U);
}

TEST_F(WithDesk, AConsentIsNotDatedInTheFuture) {
    EXPECT_EQ(study.consent(code, {"2", std::chrono::year(2026) / 11 / 25, "KL"}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(study.consent(code, {"2", study.today(), ""}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(study.find(code)->consents.size(), 1U);
}

TEST_F(Desk, TheDayAfterIsSealedForThePersonAndRedSkinIsAnAdverseEvent) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    const auto& id = begun.session.id;
    ASSERT_TRUE(study.endSession(id, StudySessionState::Complete, record(begun)));
    NextDay said{.erythema = 1, .oedema = 0, .sideEffects = {{"redness", 2, 4}}};
    EXPECT_EQ(
        study.nextDay(id, said).error().message,
        "the session was begun on 2026-11-23, and today is 2026-11-23; what is noted of the day after is noted on "
        "a later day");
    EXPECT_FALSE(study.nextDay(id));
    time.now += std::chrono::hours(24);
    EXPECT_EQ(study.nextDay("00", said).error().message, "the study has no session 00");
    for (const auto& bad : {NextDay{.erythema = 5, .oedema = 0, .sideEffects = {}},
                            NextDay{.erythema = 0, .oedema = -1, .sideEffects = {}},
                            NextDay{.erythema = 0, .oedema = 0, .sideEffects = {{"joy", 1, 1}}},
                            NextDay{.erythema = 0, .oedema = 0, .sideEffects = {{"pain", 5, 1}}},
                            NextDay{.erythema = 0, .oedema = 0, .sideEffects = {{"pain", 1, 0}}},
                            NextDay{.erythema = 0, .oedema = 0, .sideEffects = {{"pain", 1, 1}, {"pain", 2, 1}}}})
        EXPECT_EQ(study.nextDay(id, bad).error().code, ErrorCode::InvalidArgument);
    ASSERT_TRUE(study.nextDay(id, said));
    EXPECT_EQ(study.adverseEventCount(), 0U);
    said.oedema = 3;
    ASSERT_TRUE(study.nextDay(id, said));
    const auto events = study.adverseEvents().value();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].second.severity, 3);
    EXPECT_TRUE(events[0].second.what.starts_with("skin on a day after the session scored 3 of 4"));
    EXPECT_EQ(openWithoutKey()->nextDay(id), std::nullopt);
    study = *open(Study::Access::Read);
    EXPECT_EQ(study.nextDay(id), said) << "the last one counts";
    study = *open();
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_FALSE(study.nextDay(id));
    EXPECT_FALSE(study.nextDay(id, said));
    EXPECT_EQ(study.adverseEvents().value().size(), 1U);
}

TEST_F(Desk, AgeSexAndHandednessAreWordsOfBidsOrLeftOut) {
    RecordProperty("hazard", "H11");
    auto study = make();
    Participant about;
    about.age = "34";
    about.sex = "female";
    about.handedness = "left";
    const auto code = study.enrol(about).value().code;
    EXPECT_EQ(study.find(code)->age, "34");
    EXPECT_EQ(study.find(code)->sex, "female");
    EXPECT_EQ(study.find(code)->handedness, "left");
    for (const char* age : {"0", "121", "34.5", "1992-03-01", "thirty", "nan", " 34"}) {
        Participant bad;
        bad.age = age;
        EXPECT_EQ(study.enrol(bad).error().message,
                  fmt::format("age is \"{}\"; whole years from 1 to 120 are accepted, or nothing", age));
    }
    Participant bad;
    bad.sex = "F";
    EXPECT_EQ(study.enrol(bad).error().message, "sex is \"F\"; one of female, male, other is accepted, or nothing");
    bad.sex.clear();
    bad.handedness = "both";
    EXPECT_EQ(study.enrol(bad).error().message,
              "handedness is \"both\"; one of right, left, ambidextrous is accepted, or nothing");
    EXPECT_EQ(study.participants().size(), 1U);
}

TEST_F(WithDesk, WhatCouldNotBeReadBackIsNotWritten) {
    RecordProperty("hazard", "H8");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    const auto head = study.ledgerHead();
    const std::string tooLong(2001, 'x');
    EXPECT_EQ(study.adverseEvent(begun.session.id, {.what = tooLong}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(study.consent(code, {"2", study.today(), tooLong}).error().code, ErrorCode::InvalidArgument);
    Participant wordy;
    wordy.age = tooLong;
    EXPECT_EQ(study.enrol(wordy).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(study.ledgerHead(), head);
    EXPECT_EQ(study.participants().size(), 1U);
}

TEST(ScoreWords, AreShownBesideTheirNumbers) {
    EXPECT_EQ(scoreText(kEventSeverities, 3), "3 severe");
    EXPECT_EQ(scoreText(kSkinScores, 0, 0), "0 none");
    for (const int none : {-1, 0, 5, 100}) EXPECT_EQ(scoreText(kEventSeverities, none), std::to_string(none));
    EXPECT_EQ(scaleText(kEventSeverities), "1 mild, 2 moderate, 3 severe, 4 life-threatening");
    EXPECT_EQ(scaleText(kRelations), "1 none, 2 remote, 3 possible, 4 probable, 5 definite");
    EXPECT_EQ(scaleText(kSkinScores, 0), "0 none, 1 very slight, 2 well defined, 3 moderate, 4 severe");
}

TEST(ScoreWords, SkinIsAnEventNoMilderThanItScoresAndNeverLifeThreatening) {
    RecordProperty("hazard", "H12");
    EXPECT_EQ(severityOfSkin(kSkinIsAdverse), 2);
    EXPECT_EQ(severityOfSkin(3), 3);
    EXPECT_EQ(severityOfSkin(4), 3);
}

}  // namespace
}  // namespace tacto
