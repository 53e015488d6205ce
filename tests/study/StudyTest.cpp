// A study as the next program finds it: sessions, records, amendments, events and rehearsals.
#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

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
    const auto study = test::accepted(open(Study::Access::Read));
    EXPECT_EQ(study.settings().title, "Four conditions");
    ASSERT_EQ(study.participants().size(), 1U);
    const auto participant = study.find(code).value();
    EXPECT_EQ(participant.virtualSeed, 7U);
    EXPECT_EQ(participant.consents.front().by, "KL");
    EXPECT_EQ(study.find("virtual:7")->code, code);
    EXPECT_EQ(study.find("virtual:8").error().code, ErrorCode::NotFound);
    EXPECT_TRUE(study.stillApproved());
}

using WithDesk = test::WithPerson<Desk>;

TEST_F(WithDesk, ASessionIsBegunSealedEndedAndListed) {
    const auto begun = test::accepted(study.beginSession(test::someRequest(code)));
    EXPECT_EQ(begun.session.number, 1);
    EXPECT_EQ(begun.path, folder() / "sessions" / (begun.session.id + ".tacto"));
    EXPECT_EQ(begun.session.id.size(), 16U);
    EXPECT_EQ(study.unfinished(begun.session.participant)->id, begun.session.id);
    const auto head = record(begun);
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, head));
    const auto sessions = study.sessions();
    ASSERT_EQ(sessions.size(), 1U);
    EXPECT_EQ(sessions[0].state, StudySessionState::Complete);
    EXPECT_EQ(sessions[0].answered, 3);
    EXPECT_EQ(sessions[0].code, code);
    EXPECT_EQ(sessions[0].encoding, "standard");
    const auto rows = test::accepted(study.events(sessions[0]));
    EXPECT_EQ(rows.front().body["order"][0], "rough-high");
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
    auto study = test::accepted(openWithoutKey());
    EXPECT_FALSE(study.hasKey());
    ASSERT_EQ(study.participants().size(), 1U);
    EXPECT_EQ(study.participants()[0].code, "");
    EXPECT_FALSE(study.participants()[0].readable);
    EXPECT_EQ(study.participants()[0].virtualSeed, std::nullopt);
    EXPECT_EQ(study.sessions()[0].answered, 3);
    EXPECT_EQ(study.sessions()[0].encoding, "");
    EXPECT_EQ(study.find(code).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(study.sealOf(study.sessions()[0].id).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(study.leave(code).error().code, ErrorCode::Unsupported);
}

TEST_F(Desk, AWrongPassphraseIsOneSentence) {
    RecordProperty("hazard", "H11");
    static_cast<void>(make());
    EXPECT_THAT(open(Study::Access::Change, "correct horse 4712"),
                test::refused(ErrorCode::NotFound, "does not open the key file"));
}

TEST_F(WithDesk, APartOfAResumedSessionIsWhatItWasWhenItWasGoneOnWith) {
    RecordProperty("hazard", "H8");
    const auto first = study.beginSession(test::someRequest(code)).value();
    static_cast<void>(record(first));
    const auto second = test::accepted(study.continueSession(first.session.id, test::someRequest(code)));
    static_cast<void>(record(second));
    EXPECT_TRUE(study.stillApproved());
    const auto kept = scratch.path() / "kept";
    std::filesystem::copy_file(first.path, kept);
    std::filesystem::copy_file(second.path, first.path, std::filesystem::copy_options::overwrite_existing);
    EXPECT_THAT(study.stillApproved(), test::refusedSaying("is not the one that the ledger notes"));
    std::filesystem::remove(first.path);
    EXPECT_FALSE(study.stillApproved()) << "gone";
    std::filesystem::copy_file(kept, first.path);
    EXPECT_TRUE(study.stillApproved());
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
        EXPECT_THAT(study.continueSession(begun.session.id, test::someRequest(code)),
                    test::refused(ErrorCode::ParseError));
        EXPECT_EQ(study.ledgerHead(), before);
        // The session can be ended. Nobody knows what was presented in it, so the gap applies.
        ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, ""));
        EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
        time.now += std::chrono::hours(20);
        EXPECT_TRUE(study.beginSession(test::someRequest(code)));
        time.now -= std::chrono::hours(20);
    }
}

TEST_F(WithDesk, ARecordThatIsNotSealedIsNotOneOfAStudy) {
    RecordProperty("hazard", "H8");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    auto unsealed = begun;
    unsealed.seal = nullptr;  // anyone could make such a file, with any answers
    record(unsealed);
    EXPECT_EQ(study.events(begun.session).error().code, ErrorCode::ParseError);
    EXPECT_EQ(study.continueSession(begun.session.id, test::someRequest(code)).error().code, ErrorCode::ParseError);
}

TEST_F(WithDesk, ARecordThatIsGoneOrCutShortGivesNoResults) {
    RecordProperty("hazard", "H9");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    ASSERT_TRUE(study.events(begun.session));
    // The shortened chain is valid in itself.
    test::forge(begun.path, "DELETE FROM entries WHERE seq > (SELECT min(seq) FROM entries WHERE name='answer')");
    EXPECT_EQ(study.events(begun.session).error().code, ErrorCode::ParseError);
    std::filesystem::remove(begun.path);
    EXPECT_FALSE(study.events(begun.session)) << "gone is not without answers";
}

TEST_F(WithDesk, AnUnfinishedSessionGoesOnInANewPartUnderTheSameNumber) {
    RecordProperty("hazard", "H8");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    record(begun);
    const auto again = test::accepted(study.continueSession(begun.session.id, test::someRequest(code)));
    EXPECT_EQ(again.session.number, 1);
    EXPECT_EQ(again.session.parts.size(), 2U);
    EXPECT_NE(again.path, begun.path);
    record(again);
    EXPECT_EQ(study.events(again.session)->size(), 18U);
    EXPECT_EQ(study.session(begun.session.id)->answered, 6);
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, ""));
    EXPECT_EQ(study.continueSession(begun.session.id, test::someRequest(code)).error().code, kGateRefused);
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
    const auto again = test::accepted(openWithoutKey());
    EXPECT_EQ(again.settings().blocks, 4);
    EXPECT_EQ(again.settings().approval.reference, "EC-2026-17 A1");
    ASSERT_EQ(again.amendments().size(), 1U);
    EXPECT_EQ(again.amendments()[0].reference, "EC-2026-17 A1");
    EXPECT_EQ(again.amendments()[0].at, time.now);
    EXPECT_EQ(again.amendments()[0].changed, (std::vector<std::string>{"approval.expires", "blocks"}));
}

TEST_F(WithDesk, AdverseEventsSurviveAWithdrawal) {
    RecordProperty("hazard", "H12");
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
    const auto again = test::accepted(open(Study::Access::Read));
    EXPECT_EQ(again.labelSeed().value(), seed);
    EXPECT_EQ(again.firstPlaces(), 5);
    EXPECT_EQ(openWithoutKey()->labelSeed().error().code, ErrorCode::Unsupported);
    const auto other = Study::create(scratch.path() / "other", test::someStudy(), test::somePassphrase(), around());
    EXPECT_NE(other->labelSeed().value(), seed);
}

TEST_F(Desk, ARehearsalNeedsNoPassphraseAndSaysSo) {
    std::string code;
    {
        auto study = test::accepted(Study::createRehearsal(folder(), {}, around()));
        Participant third;
        third.virtualSeed = 3;
        code = study.enrol(third)->code;
        ASSERT_TRUE(study.consent("virtual:3", {study.settings().consentVersion, study.today(), "rehearsal"}));
        auto request = test::someRequest("virtual:3");
        request.script = {"anything", "x"};
        for (int i = 0; i < 6; ++i) {  // rehearsals have no gap and no limit on sessions
            const auto begun = test::accepted(study.beginSession(request));
            ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
        }
    }
    const auto study = test::accepted(openWithoutKey());
    EXPECT_TRUE(study.hasKey());
    EXPECT_EQ(study.find("virtual:3")->code, code);
    EXPECT_NE(everythingBelow(folder()).find("not secret"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "home"));
}

}  // namespace
}  // namespace tacto
