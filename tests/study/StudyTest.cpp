#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Comes.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using Desk = test::StudyDesk;

TEST_F(Desk, WhatWasMadeIsThereForTheNextProgram) {
    std::string code;
    {
        auto study = make();
        code = enrolled(study, 7);
        EXPECT_FALSE(study.isRehearsal());
    }
    const auto study = open(Study::Access::Read);
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_EQ(study->settings().title, "Four conditions");
    ASSERT_EQ(study->participants().size(), 1U);
    const auto participant = study->find(code).value();
    EXPECT_EQ(participant.virtualSeed, 7U);
    EXPECT_EQ(participant.consents.front().by, "KL");
    EXPECT_EQ(study->find("virtual:7")->code, code);
    EXPECT_EQ(study->find("virtual:8").error().code, ErrorCode::NotFound);
    EXPECT_TRUE(study->stillApproved());
}

TEST_F(Desk, ASessionIsBegunSealedEndedAndListed) {
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code));
    ASSERT_TRUE(begun) << begun.error().message;
    EXPECT_EQ(begun->session.number, 1);
    EXPECT_EQ(begun->path, folder() / "sessions" / (begun->session.id + ".tacto"));
    EXPECT_EQ(begun->session.id.size(), 16U);
    EXPECT_EQ(study.unfinished(begun->session.participant)->id, begun->session.id);
    const auto head = record(*begun);
    ASSERT_TRUE(study.endSession(begun->session.id, StudySessionState::Complete, head));
    const auto sessions = study.sessions();
    ASSERT_EQ(sessions.size(), 1U);
    EXPECT_EQ(sessions[0].state, StudySessionState::Complete);
    EXPECT_EQ(sessions[0].answered, 3);
    EXPECT_EQ(sessions[0].code, code);
    EXPECT_EQ(sessions[0].encoding, "standard");
    const auto rows = study.events(sessions[0]);
    ASSERT_TRUE(rows) << rows.error().message;
    EXPECT_EQ(rows->front().body["order"][0], "rough-high");
}

TEST_F(Desk, WithoutThePassphraseNothingOfAPersonIsRead) {
    RecordProperty("hazard", "H11");
    std::string code;
    {
        auto study = make();
        code = enrolled(study);
        const auto begun = study.beginSession(test::someRequest(code)).value();
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    }
    auto study = openWithoutKey();
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_FALSE(study->hasKey());
    ASSERT_EQ(study->participants().size(), 1U);
    EXPECT_EQ(study->participants()[0].code, "");
    EXPECT_FALSE(study->participants()[0].readable);
    EXPECT_EQ(study->participants()[0].virtualSeed, std::nullopt);
    EXPECT_EQ(study->sessions()[0].answered, 3);
    EXPECT_EQ(study->sessions()[0].encoding, "");
    EXPECT_EQ(study->find(code).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(study->sealOf(study->sessions()[0].id).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(study->leave(code).error().code, ErrorCode::Unsupported);
}

TEST_F(Desk, AWrongPassphraseIsOneSentence) {
    RecordProperty("hazard", "H11");
    static_cast<void>(make());
    const auto study = open(Study::Access::Change, "correct horse 4712");
    ASSERT_FALSE(study);
    EXPECT_EQ(study.error().code, ErrorCode::NotFound);
    EXPECT_NE(study.error().message.find("does not open the key file"), std::string::npos);
}

/// Nothing is made when a gate refuses: folder and keys are the same, byte for byte.
class GateOfASession : public Desk {
protected:
    void expectRefused(Study& study, const SessionRequest& request, std::string_view part,
                       ErrorCode code = kGateRefused) {
        RecordProperty("hazard", "H12");
        const auto head = study.ledgerHead();
        const auto bytes = everythingBelow(scratch.path());
        const auto begun = study.beginSession(request);
        ASSERT_FALSE(begun);
        EXPECT_EQ(begun.error().code, code);
        EXPECT_NE(begun.error().message.find(part), std::string::npos) << begun.error().message;
        EXPECT_EQ(study.ledgerHead(), head);
        EXPECT_TRUE(everythingBelow(scratch.path()) == bytes);
        EXPECT_TRUE(std::filesystem::is_empty(folder() / "sessions"));
    }
};

TEST_F(GateOfASession, EachRefusesWithItsSentence) {
    auto study = make();
    const auto code = enrolled(study);
    const auto request = test::someRequest(code);
    auto other = request;
    other.script.sha256 = std::string(64, 'f');
    expectRefused(study, other, "a changed script needs an amendment");
    other = request;
    other.codeConfirmed = false;
    expectRefused(study, other, "has not confirmed that the code");
    other = request;
    other.exclusions.front().yes = true;
    expectRefused(study, other, "no session today");
    other = request;
    other.exclusions.pop_back();
    expectRefused(study, other, "1 of the 10 questions");
    other = request;
    other.devicesSimulated = false;
    expectRefused(study, other, "only simulated devices are accepted");
    other = request;
    other.code = "P-7K3M";
    expectRefused(study, other, "its check character is wrong", ErrorCode::NotFound);
    other.code = "P-7K3D";
    expectRefused(study, other, "the study has no participant P-7K3D", ErrorCode::NotFound);
    Participant unwilling;
    unwilling.virtualSeed = 9;
    other.code = study.enrol(unwilling)->code;
    expectRefused(study, other, "has given no consent");
    time.now += std::chrono::hours(24 * 400);
    expectRefused(study, request, "expired on 2027-10-31");
    time.now -= std::chrono::hours(24 * 401);
    expectRefused(study, request, "set the clock");
    time.now += std::chrono::hours(24);
    ASSERT_TRUE(study.leave(code));
    expectRefused(study, request, "has left the study");
    EXPECT_TRUE(study.stillApproved());
}

TEST_F(GateOfASession, AYesEndsThePersonsDayWhateverIsAnsweredLater) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = study.enrol({}).value().code;
    ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    auto request = test::someRequest(code);
    request.devicesSimulated = false;
    auto yes = request;
    yes.exclusions.front().yes = true;
    const auto before = study.ledgerHead();
    ASSERT_TRUE(study.noteExclusions(request));
    EXPECT_EQ(study.ledgerHead(), before) << "nothing was answered with yes";
    ASSERT_TRUE(study.noteExclusions(yes));
    expectRefused(study, request, "answered yes to the exclusion checklist today");
    EXPECT_EQ(everythingBelow(folder()).find(yes.exclusions.front().key), std::string::npos);
    time.now += std::chrono::hours(24);
    EXPECT_TRUE(study.mayBegin(request));
    EXPECT_TRUE(study.beginSession(request));
}

TEST_F(GateOfASession, AYesHoldsWhenTheClockIsSetBackOverMidnight) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = study.enrol({}).value().code;
    ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    auto request = test::someRequest(code);
    request.devicesSimulated = false;
    for (const auto today = study.today(); study.today() == today;) time.now += std::chrono::minutes(1);
    request.exclusions.front().yes = true;
    ASSERT_TRUE(study.noteExclusions(request));
    request.exclusions = nothingExcludes();
    time.now -= std::chrono::minutes(4);
    expectRefused(study, request, "answered yes to the exclusion checklist today");
}

TEST_F(Desk, APartOfAResumedSessionIsWhatItWasWhenItWasGoneOnWith) {
    RecordProperty("hazard", "H8");
    auto study = make();
    const auto code = enrolled(study);
    const auto first = study.beginSession(test::someRequest(code)).value();
    static_cast<void>(record(first));
    const auto second = study.continueSession(first.session.id, test::someRequest(code));
    ASSERT_TRUE(second) << second.error().message;
    static_cast<void>(record(*second));
    EXPECT_TRUE(study.stillApproved());
    const auto kept = scratch.path() / "kept";
    std::filesystem::copy_file(first.path, kept);
    std::filesystem::copy_file(second->path, first.path, std::filesystem::copy_options::overwrite_existing);
    const auto exchanged = study.stillApproved();
    ASSERT_FALSE(exchanged);
    EXPECT_NE(exchanged.error().message.find("is not the one that the ledger notes"), std::string::npos);
    std::filesystem::remove(first.path);
    EXPECT_FALSE(study.stillApproved()) << "gone";
    std::filesystem::copy_file(kept, first.path);
    EXPECT_TRUE(study.stillApproved());
}

TEST_F(Desk, TheNextSessionWaitsForTheGap) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, ErrorCode::Unsupported);  // unfinished
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, record(begun)));
    time.now += std::chrono::hours(19);
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
    time.now += std::chrono::hours(1);
    const auto next = study.beginSession(test::someRequest(code));
    ASSERT_TRUE(next) << next.error().message;
    EXPECT_EQ(next->session.number, 2);
}

TEST_F(Desk, TheGapIsCountedFromTheFirstTrainAndNotFromTheChecklist) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    test::HandClock clock;  // as on a real bench, an event's time is that of the wall
    auto writer = SessionWriter::create(begun.path, {}, clock, begun.seal);
    ASSERT_TRUE(writer) << writer.error().message;
    clock.advance(std::chrono::minutes(18));
    ASSERT_TRUE((*writer)->event(clock.now(), "trial-begin", {{"name", "ascending 1"}}));
    clock.advance(std::chrono::minutes(30));
    ASSERT_TRUE((*writer)->event(clock.now(), "trial-begin", {{"name", "test 90"}}));
    ASSERT_TRUE((*writer)->close());
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, (*writer)->chainHead()));
    time.now += std::chrono::hours(20) + std::chrono::minutes(17);
    EXPECT_NE(study.mayBegin(test::someRequest(code)).error().message.find("20.0 h ago; at least 20 h"),
              std::string::npos);
    time.now += std::chrono::minutes(1);
    EXPECT_TRUE(study.beginSession(test::someRequest(code)));
}

TEST_F(Desk, OnTheComputersOwnClockSessionsWaitForTheGapAndOneThatWasCancelledForNothing) {
    RecordProperty("hazard", "H12");
    auto settings = test::someStudy();
    settings.approval.from = std::chrono::year(2026) / 1 / 1;
    settings.approval.expires = std::chrono::year(2099) / 12 / 31;
    settings.gapMin_h = 1.0 / 3600;
    auto real = around();
    real.time = &SystemTime::real();
    auto study = Study::create(folder(), settings, test::somePassphrase(), real).value();
    const auto code = enrolled(study);
    const auto cancelled = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.cancelSession(cancelled.session.id));
    const auto begun = study.beginSession(test::someRequest(code));
    ASSERT_TRUE(begun) << begun.error().message;
    const SteadyClock clock;
    auto writer = SessionWriter::create(begun->path, {}, clock, begun->seal);
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE((*writer)->event(clock.now(), "trial-begin", {{"name", "ascending 1"}}));
    ASSERT_TRUE((*writer)->close());
    ASSERT_TRUE(study.endSession(begun->session.id, StudySessionState::Stopped, (*writer)->chainHead()));
    auto amended = study.settings();
    amended.gapMin_h = 20;
    ASSERT_TRUE(study.amend(amended, "EC-2026-18"));
    EXPECT_EQ(study.mayBegin(test::someRequest(code)).error().code, kGateRefused);
    amended.gapMin_h = settings.gapMin_h;
    ASSERT_TRUE(study.amend(amended, "EC-2026-19"));
    EXPECT_IN_TIME(test::comes([&] { return study.mayBegin(test::someRequest(code)).has_value(); }));
    ASSERT_EQ(study.sessions().size(), 2U);
    EXPECT_FALSE(study.sessions().front().opened);
}

TEST_F(Desk, ASessionInWhichNothingWasPresentedCostsNoDay) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    for (int i = 0; i < study.settings().sessionsMax + 1; ++i) {
        const auto booked = study.beginSession(test::someRequest(code));
        ASSERT_TRUE(booked) << booked.error().message;
        ASSERT_TRUE(study.cancelSession(booked->session.id));
        EXPECT_FALSE(study.cancelSession(booked->session.id)) << "once";
    }
    auto next = study.beginSession(test::someRequest(code));
    ASSERT_TRUE(next) << next.error().message;
    std::ofstream(next->path) << "no session";  // what cannot be read may hold anything
    ASSERT_TRUE(study.endSession(next->session.id, StudySessionState::Stopped, ""));
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
}

TEST_F(Desk, ASessionWhoseFileIsGoneCountsFromItsBeginning) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_FALSE(std::filesystem::exists(begun.path)) << "killed before it was made, or lost: both look like this";
    EXPECT_EQ(study.mayBegin(test::someRequest(code)).error().code, kGateRefused);
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, ""));
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
    time.now += std::chrono::hours(20);
    EXPECT_TRUE(study.beginSession(test::someRequest(code)));
}

TEST_F(Desk, ARecordThatWasExchangedBarsTheNextSession) {
    RecordProperty("hazard", "H8");
    auto study = make();
    const auto first = enrolled(study, 1), second = enrolled(study, 2);
    const auto begun = study.beginSession(test::someRequest(first)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    ASSERT_TRUE(std::filesystem::remove(begun.path));
    record(begun);  // the same rows, other seals
    const auto next = study.beginSession(test::someRequest(second));
    ASSERT_FALSE(next);
    EXPECT_EQ(next.error().code, kGateRefused);
    EXPECT_NE(next.error().message.find("is not the one that the ledger notes"), std::string::npos);
}

TEST_F(Desk, ARecordThatWasChangedAmongItsRowsBarsTheNextSession) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    ASSERT_TRUE(study.stillApproved());
    ASSERT_TRUE(study.events(begun.session));
    // The head of its chain stays: nothing was presented, it says now, and the gap would be none.
    test::forge(begun.path, "UPDATE entries SET name='note' WHERE name='trial-begin'");
    const auto next = study.beginSession(test::someRequest(code));
    ASSERT_FALSE(next);
    EXPECT_NE(next.error().message.find("is not the one that the ledger notes"), std::string::npos)
        << next.error().message;
    EXPECT_FALSE(study.events(begun.session));
}

TEST_F(Desk, NothingGoesOnFromARecordThatIsNotWholeAndNothingIsReadFromIt) {
    RecordProperty("hazard", "H6");
    const std::pair<const char*, const char*> changes[] = {
        {"an answer is gone",
         "DELETE FROM entries WHERE name='answer' AND seq="
         "(SELECT max(seq) FROM entries WHERE name='answer')"},
        {"its plan is gone", "DELETE FROM entries WHERE name='plan'"},
        {"another name", "UPDATE entries SET name='note' WHERE name='trial-begin'"},
        {"another time", "UPDATE entries SET t_ns=t_ns+1000000000 WHERE name='answer'"},
        {"another number",
         "UPDATE entries SET seq=seq+100 WHERE name='answer' AND seq="
         "(SELECT max(seq) FROM entries WHERE name='answer')"}};
    for (const auto& [what, sql] : changes) {
        SCOPED_TRACE(what);
        std::filesystem::remove_all(folder());
        std::filesystem::remove_all(scratch.path() / "home");
        auto study = make();
        const auto code = enrolled(study);
        const auto begun = study.beginSession(test::someRequest(code)).value();
        record(begun);
        test::forge(begun.path, sql);
        EXPECT_EQ(study.events(begun.session).error().code, ErrorCode::ParseError);
        const auto before = study.ledgerHead();
        const auto again = study.continueSession(begun.session.id, test::someRequest(code));
        ASSERT_FALSE(again);
        EXPECT_EQ(again.error().code, ErrorCode::ParseError) << again.error().message;
        EXPECT_EQ(study.ledgerHead(), before);
        // It can be ended; what was presented in it is not known, so the gap counts.
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, ""));
        EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
        time.now += std::chrono::hours(20);
        EXPECT_TRUE(study.beginSession(test::someRequest(code)));
        time.now -= std::chrono::hours(20);
    }
}

TEST_F(Desk, ARecordThatIsNotSealedIsNotOneOfAStudy) {
    RecordProperty("hazard", "H8");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    auto unsealed = begun;
    unsealed.seal = nullptr;  // anyone can make one, with any answers
    record(unsealed);
    EXPECT_EQ(study.events(begun.session).error().code, ErrorCode::ParseError);
    EXPECT_EQ(study.continueSession(begun.session.id, test::someRequest(code)).error().code, ErrorCode::ParseError);
}

TEST_F(Desk, ARecordThatIsGoneOrCutShortGivesNoResults) {
    RecordProperty("hazard", "H9");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    ASSERT_TRUE(study.events(begun.session));
    // Its chain is whole in itself.
    test::forge(begun.path, "DELETE FROM entries WHERE seq > (SELECT min(seq) FROM entries WHERE name='answer')");
    EXPECT_EQ(study.events(begun.session).error().code, ErrorCode::ParseError);
    std::filesystem::remove(begun.path);
    EXPECT_FALSE(study.events(begun.session)) << "gone is not without answers";
}

TEST_F(Desk, AnUnfinishedSessionGoesOnInANewPartUnderTheSameNumber) {
    RecordProperty("hazard", "H8");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    record(begun);
    const auto again = study.continueSession(begun.session.id, test::someRequest(code));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->session.number, 1);
    EXPECT_EQ(again->session.parts.size(), 2U);
    EXPECT_NE(again->path, begun.path);
    record(*again);
    EXPECT_EQ(study.events(again->session)->size(), 18U);
    EXPECT_EQ(study.session(begun.session.id)->answered, 6);
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, ""));
    EXPECT_EQ(study.continueSession(begun.session.id, test::someRequest(code)).error().code, kGateRefused);
}

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
    auto study = open();
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_EQ(study->find(code).error().code, ErrorCode::NotFound);
    EXPECT_EQ(study->sealOf(file).error().code, ErrorCode::Unsupported);
    EXPECT_FALSE(study->events(study->sessions()[0]));
    const auto gone = study->participants()[0];
    EXPECT_EQ(gone.state, ParticipantState::Withdrawn);
    EXPECT_EQ(gone.sessions, 1);
    EXPECT_EQ(gone.code, "");
    EXPECT_TRUE(gone.consents.empty());
    EXPECT_TRUE(SessionReader::open(path)->locked());
    EXPECT_TRUE(study->stillApproved());  // the chains stay whole
    EXPECT_EQ(everythingBelow(scratch.path() / "home").find(code), std::string::npos);
}

TEST_F(GateOfASession, AZoneThatThereIsNotRevivesNoApproval) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto code = enrolled(study);
    const auto zone = [](const char* text) {
        if (text != nullptr)
            ::setenv("TZ", text, 1);
        else
            ::unsetenv("TZ");
        ::tzset();
    };
    const char* was = std::getenv("TZ");
    const auto before = was != nullptr ? std::optional(std::string(was)) : std::nullopt;
    time.now = std::chrono::sys_days(std::chrono::year(2027) / 11 / 1) + std::chrono::hours(12);
    zone("AAA+23");
    EXPECT_EQ(study.today(), std::chrono::year(2027) / 10 / 31) << "its last day";
    expectRefused(study, test::someRequest(code), "is -23.0 h ahead of UTC");
    zone(before ? before->c_str() : nullptr);
}

TEST_F(Desk, WhoLeavesKeepsTheirData) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto code = enrolled(study);
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
    EXPECT_EQ(study.enrol({}).error().code, kGateRefused);  // they took part
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
    for (const char* same : {"P7K3D", "P-7-K3D", "p7k3-d"}) {  // who forgets a hyphen is no other person
        named.code = same;
        EXPECT_EQ(study.enrol(named).error().code, ErrorCode::Unsupported) << same;
    }
    EXPECT_EQ(study.participants().size(), 2U);
}

TEST_F(Desk, AConsentIsNotDatedInTheFuture) {
    auto study = make();
    const auto code = enrolled(study);
    EXPECT_EQ(study.consent(code, {"2", std::chrono::year(2026) / 11 / 25, "KL"}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(study.consent(code, {"2", study.today(), ""}).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(study.find(code)->consents.size(), 1U);
}

TEST_F(Desk, AnAmendmentHasAReferenceOfItsOwnAndBindsWhatItChanges) {
    RecordProperty("hazard", "H11");
    auto study = make();
    auto changed = study.settings();
    changed.blocks = 4;
    EXPECT_EQ(study.amend(changed, "EC-2026-17").error().code, ErrorCode::InvalidArgument);
    changed.approval.expires = std::chrono::year(2028) / 10 / 31;
    ASSERT_TRUE(study.amend(changed, "EC-2026-17 A1"));
    EXPECT_EQ(study.amend(changed, "EC-2026-17 A1").error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(study.amend(changed, "EC-2026-17").error().code, ErrorCode::InvalidArgument) << "the first approval's";
    EXPECT_TRUE(study.stillApproved());
    enrolled(study, 1);
    enrolled(study, 2);
    auto fewer = study.settings();
    fewer.participantsMax = 1;
    EXPECT_EQ(study.amend(fewer, "EC-2026-17 A2").error().message,
              "participants_max is 1, and 2 are enrolled; that or more is expected");
    const auto again = openWithoutKey();
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->settings().blocks, 4);
    EXPECT_EQ(again->settings().approval.reference, "EC-2026-17 A1");
    ASSERT_EQ(again->amendments().size(), 1U);
    EXPECT_EQ(again->amendments()[0].reference, "EC-2026-17 A1");
    EXPECT_EQ(again->amendments()[0].at, time.now);
    EXPECT_EQ(again->amendments()[0].changed, (std::vector<std::string>{"approval.expires", "blocks"}));
}

TEST_F(Desk, AdverseEventsSurviveAWithdrawal) {
    RecordProperty("hazard", "H12");
    auto study = make();
    const auto code = enrolled(study);
    const auto begun = study.beginSession(test::someRequest(code)).value();
    EXPECT_FALSE(study.adverseEvent(begun.session.id, {.what = "redness", .severity = 5}));
    ASSERT_TRUE(study.adverseEvent(begun.session.id, {.what = "redness", .severity = 2, .relation = 4}));
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, record(begun)));
    ASSERT_TRUE(study.withdraw(code));
    EXPECT_EQ(openWithoutKey()->adverseEventCount(), 1U);
    const auto events = study.adverseEvents().value();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].first, begun.session.id);
    EXPECT_EQ(events[0].second.what, "redness");
    EXPECT_EQ(everythingBelow(folder()).find("redness"), std::string::npos);
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

TEST_F(Desk, WhatCouldNotBeReadBackIsNotWritten) {
    RecordProperty("hazard", "H8");
    auto study = make();
    const auto code = enrolled(study);
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

TEST_F(Desk, LabelsOfExportsComeFromTheKeyAndStay) {
    RecordProperty("hazard", "H11");
    std::uint64_t seed = 0;
    {
        auto study = make();
        seed = study.labelSeed().value();
        EXPECT_NE(seed, std::stoull(study.settings().id, nullptr, 16));
        EXPECT_EQ(study.firstPlaces(), 5);
        auto more = study.settings();
        more.participantsMax = 9;
        ASSERT_TRUE(study.amend(more, "EC-2026-17 A1"));
    }
    const auto again = open(Study::Access::Read);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->labelSeed().value(), seed);
    EXPECT_EQ(again->firstPlaces(), 5);
    EXPECT_EQ(openWithoutKey()->labelSeed().error().code, ErrorCode::Unsupported);
    const auto other = Study::create(scratch.path() / "other", test::someStudy(), test::somePassphrase(), around());
    EXPECT_NE(other->labelSeed().value(), seed);
}

TEST_F(Desk, ARehearsalNeedsNoPassphraseAndSaysSo) {
    std::string code;
    {
        auto study = Study::createRehearsal(folder(), {}, around());
        ASSERT_TRUE(study) << study.error().message;
        Participant third;
        third.virtualSeed = 3;
        code = study->enrol(third)->code;
        ASSERT_TRUE(study->consent("virtual:3", {study->settings().consentVersion, study->today(), "rehearsal"}));
        auto request = test::someRequest("virtual:3");
        request.script = {"anything", "x"};
        for (int i = 0; i < 6; ++i) {  // neither a gap nor a number is asked for
            const auto begun = study->beginSession(request);
            ASSERT_TRUE(begun) << begun.error().message;
            ASSERT_TRUE(study->endSession(begun->session.id, StudySessionState::Complete, record(*begun)));
        }
    }
    const auto study = openWithoutKey();
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_TRUE(study->hasKey());
    EXPECT_EQ(study->find("virtual:3")->code, code);
    EXPECT_NE(everythingBelow(folder()).find("not secret"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "home"));
}

TEST_F(Desk, AProcedureThatWasNotApprovedBeginsNoSession) {
    RecordProperty("hazard", "H11");
    auto settings = test::someStudy();
    settings.procedure = {0.5, 2, DetectionMethod::Quest, std::string(64, 'a')};
    auto study = make(settings);
    auto request = test::someRequest(enrolled(study));
    const auto refused = study.beginSession(request);
    ASSERT_FALSE(refused) << "one that says nothing of it";
    EXPECT_EQ(refused.error().code, kGateRefused);
    EXPECT_TRUE(study.sessions().empty());
    request.procedure = *settings.procedure;
    request.procedure.intervalMax_s = 3;
    EXPECT_FALSE(study.mayBegin(request));
    auto amended = study.settings();
    amended.procedure->intervalMax_s = 3;
    ASSERT_TRUE(study.amend(amended, "EC-2026-18"));
    EXPECT_EQ(study.amendments().back().changed, std::vector<std::string>{"procedure.interval_max_s"});
    EXPECT_TRUE(study.beginSession(request));
    request.procedure.intervalMax_s = 2;
    EXPECT_FALSE(study.continueSession(study.sessions().front().id, request)) << "nor goes one on";
}

}  // namespace
}  // namespace tacto
