// What a session needs to begin: each gate, the gap between sessions, and records that are complete.
#include <random>

#include "tests/session/SessionSupport.h"
#include "tests/study/StudySupport.h"
#include "tests/support/Comes.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using Desk = test::StudyDesk;

/// If a gate refuses, nothing is created: the study's folder and keys stay the same, byte for byte.
class GateOfASession : public Desk {
protected:
    /// `known`: when this is known.
    enum class Known { Beforehand, WithTheChecklist };
    void expectRefused(Study& study, const SessionRequest& request, std::string_view part,
                       ErrorCode code = kGateRefused, Known known = Known::Beforehand) {
        RecordProperty("hazard", "H12");
        if (const auto who = study.find(request.code)) {
            const auto may = study.mayTakePart(*who, false);
            EXPECT_EQ(may.has_value(), known == Known::WithTheChecklist) << part;
            if (!may) EXPECT_THAT(may, test::refused(code, part));
        }
        const auto head = study.ledgerHead();
        const auto bytes = everythingBelow(scratch.path());
        EXPECT_THAT(study.beginSession(request), test::refused(code, part));
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
    expectRefused(study, other, "a changed script needs an amendment", kGateRefused, Known::WithTheChecklist);
    other = request;
    other.codeConfirmed = false;
    expectRefused(study, other, "has not confirmed that the code", kGateRefused, Known::WithTheChecklist);
    other = request;
    other.exclusions.front().yes = true;
    expectRefused(study, other, "no session today", kGateRefused, Known::WithTheChecklist);
    other = request;
    other.exclusions.pop_back();
    expectRefused(study, other, "1 of the 10 questions", kGateRefused, Known::WithTheChecklist);
    other = request;
    other.devicesSimulated = false;
    expectRefused(study, other, "only simulated devices are accepted", kGateRefused, Known::WithTheChecklist);
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

TEST_F(GateOfASession, AnAgeBelowAnAmendmentsIsRefusedBeforehand) {
    auto study = make();
    Participant young;
    young.age = "19";
    const auto code = study.enrol(young).value().code;
    ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    EXPECT_TRUE(study.mayTakePart(*study.find(code), false));
    auto amended = study.settings();
    amended.ageMin = 21;
    ASSERT_TRUE(study.amend(amended, "EC-2026-18"));
    expectRefused(study, test::someRequest(code), "19 years is below");
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

TEST_F(GateOfASession, AClockThatIsSetBackDatesNothingBack) {
    RecordProperty("hazard", "H12");
    for (const int days : {1, 2, 20, 400}) {
        SCOPED_TRACE(days);
        std::filesystem::remove_all(folder());
        auto study = make();
        const auto code = study.enrol({}).value().code;
        const auto today = study.today();
        ASSERT_TRUE(study.consent(code, {"2", today, "KL"}));
        const auto back = std::chrono::hours(24 * days);
        auto request = test::someRequest(code);
        request.devicesSimulated = false;
        // A form approved today is not valid on the earlier day that the clock now shows.
        time.now -= back;
        auto amended = study.settings();
        amended.consentVersion = "3";
        ASSERT_TRUE(study.amend(amended, "EC-2026-18"));
        time.now += back;
        const std::chrono::sys_days before = std::chrono::sys_days(today) - std::chrono::days(1);
        EXPECT_FALSE(study.consent(code, {"3", before, "KL"}));
        ASSERT_TRUE(study.consent(code, {"3", today, "KL"}));
        ASSERT_TRUE(study.mayBegin(request));
        // A "yes" of today does not become an earlier one when the clock is set back.
        time.now -= back;
        request.exclusions.front().yes = true;
        ASSERT_TRUE(study.noteExclusions(request));
        request.exclusions = nothingExcludes();
        time.now += back;
        expectRefused(study, request, "answered yes to the exclusion checklist today");
    }
}

using WithDesk = test::WithPerson<Desk>;

TEST_F(WithDesk, TheNextSessionWaitsForTheGap) {
    RecordProperty("hazard", "H12");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, ErrorCode::Unsupported);  // unfinished
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, record(begun)));
    time.now += std::chrono::hours(19);
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
    EXPECT_THAT(study.mayTakePart(*study.find(code), false), test::refusedSaying("the next session is possible from"));
    time.now += std::chrono::hours(1);
    const auto next = test::accepted(study.beginSession(test::someRequest(code)));
    EXPECT_EQ(next.session.number, 2);
}

TEST_F(WithDesk, TheGapIsCountedFromTheFirstTrainAndNotFromTheChecklist) {
    RecordProperty("hazard", "H12");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    test::HandClock clock;  // as on a real bench, an event's time comes from the wall clock
    auto writer = test::accepted(SessionWriter::create(begun.path, {}, clock, begun.seal));
    clock.advance(std::chrono::minutes(18));
    ASSERT_TRUE(writer->event(clock.now(), "trial-begin", {{"name", "ascending 1"}}));
    clock.advance(std::chrono::minutes(30));
    ASSERT_TRUE(writer->event(clock.now(), "trial-begin", {{"name", "test 90"}}));
    ASSERT_TRUE(writer->close());
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, writer->chainHead()));
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
    const auto begun = test::accepted(study.beginSession(test::someRequest(code)));
    const SteadyClock clock;
    auto writer = test::accepted(SessionWriter::create(begun.path, {}, clock, begun.seal));
    ASSERT_TRUE(writer->event(clock.now(), "trial-begin", {{"name", "ascending 1"}}));
    ASSERT_TRUE(writer->close());
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Stopped, writer->chainHead()));
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

TEST_F(WithDesk, ASessionInWhichNothingWasPresentedCostsNoDay) {
    RecordProperty("hazard", "H12");
    for (int i = 0; i < study.settings().sessionsMax + 1; ++i) {
        const auto booked = test::accepted(study.beginSession(test::someRequest(code)));
        ASSERT_TRUE(study.cancelSession(booked.session.id));
        EXPECT_FALSE(study.cancelSession(booked.session.id)) << "once";
    }
    auto next = test::accepted(study.beginSession(test::someRequest(code)));
    std::ofstream(next.path) << "no session";  // a file that cannot be read may contain trials
    ASSERT_TRUE(study.endSession(next.session.id, StudySessionState::Stopped, ""));
    EXPECT_EQ(study.beginSession(test::someRequest(code)).error().code, kGateRefused);
}

TEST_F(WithDesk, ASessionWhoseFileIsGoneCountsFromItsBeginning) {
    RecordProperty("hazard", "H12");
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
    record(begun);  // the same rows with different seals
    EXPECT_THAT(study.beginSession(test::someRequest(second)),
                test::refused(kGateRefused, "is not the one that the ledger notes"));
}

TEST_F(WithDesk, ARecordThatWasChangedAmongItsRowsBarsTheNextSession) {
    RecordProperty("hazard", "H12");
    const auto begun = study.beginSession(test::someRequest(code)).value();
    ASSERT_TRUE(study.endSession(begun.session.id, StudySessionState::Complete, record(begun)));
    ASSERT_TRUE(study.stillApproved());
    ASSERT_TRUE(study.events(begun.session));
    // The chain head stays the same, but the file now says that nothing was presented, so there would be no gap.
    test::forge(begun.path, "UPDATE entries SET name='note' WHERE name='trial-begin'");
    EXPECT_THAT(study.beginSession(test::someRequest(code)),
                test::refusedSaying("is not the one that the ledger notes"));
    EXPECT_FALSE(study.events(begun.session));
}

/// Sets this process's time zone (TZ) as long as this object exists.
class Zone {
public:
    explicit Zone(const char* text) {
        if (const char* was = std::getenv("TZ")) before_ = was;
        ::setenv("TZ", text, 1);
        ::tzset();
    }
    ~Zone() {
        if (before_)
            ::setenv("TZ", before_->c_str(), 1);
        else
            ::unsetenv("TZ");
        ::tzset();
    }
    Zone(const Zone&) = delete;
    Zone& operator=(const Zone&) = delete;

private:
    std::optional<std::string> before_;
};

using WithGateOfASession = test::WithPerson<GateOfASession>;

TEST_F(WithGateOfASession, NoTimeZoneMovesADay) {
    RecordProperty("hazard", "H11");
    const auto person = study.enrol({}).value().code;
    const auto last = std::chrono::sys_days(std::chrono::year(2027) / 10 / 31);
    using namespace std::chrono_literals;
    std::mt19937 random(47);
    for (int i = 0; i < 60; ++i) {
        const auto zone = fmt::format("Z{}{:+}", "AB", static_cast<int>(random() % 49) - 24);
        SCOPED_TRACE(zone);
        const Zone here(zone.c_str());
        const auto second = std::chrono::seconds(random() % 86'400);
        time.now = last + second;
        EXPECT_EQ(study.today(), std::chrono::year(2027) / 10 / 31);
        EXPECT_TRUE(study.mayBegin(test::someRequest(code)));
        time.now = last + 24h + second;
        expectRefused(study, test::someRequest(code), "expired on 2027-10-31, and today is 2027-11-01");
    }
    time.now = last - 24h * 300 + 23h + 59min;
    auto yes = test::someRequest(person);
    yes.exclusions.front().yes = true;
    ASSERT_TRUE(study.consent(person, {"2", study.today(), "KL"}));
    ASSERT_TRUE(study.noteExclusions(yes));
    auto request = test::someRequest(person);
    request.devicesSimulated = false;
    for (const char* zone : {"E-14", "W+12", "A+24"}) {
        const Zone here(zone);
        expectRefused(study, request, "answered yes to the exclusion checklist today");
    }
}

TEST_F(GateOfASession, AConsentFromBeforeTheApprovalOrTheFormsVersionOpensNone) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto code = study.enrol({}).value().code;
    const auto dated = [&](const char* version, int month, int day) {
        return study.consent(code, {version, std::chrono::year(2026) / month / day, "KL"});
    };
    EXPECT_THAT(dated("2", 10, 31),
                test::refused(ErrorCode::InvalidArgument, "version 2 of the form is approved from 2026-11-01"));
    ASSERT_TRUE(dated("2", 11, 1));
    auto request = test::someRequest(code);
    request.devicesSimulated = false;
    EXPECT_TRUE(study.mayBegin(request));
    EXPECT_THAT(dated("3", 11, 20),
                test::refused(ErrorCode::InvalidArgument, "version 2, which is in force, is expected"));
    auto amended = study.settings();
    amended.consentVersion = "3";
    ASSERT_TRUE(study.amend(amended, "EC-2026-18"));
    expectRefused(study, request, "has consented to version 2, and version 3 is in force");
    EXPECT_FALSE(dated("3", 11, 22));
    ASSERT_TRUE(dated("3", 11, 23));
    EXPECT_TRUE(study.mayBegin(request));
    time.now += std::chrono::hours(24 * 300);
    amended.approval.from = std::chrono::year(2027) / 9 / 1;
    amended.approval.expires = std::chrono::year(2028) / 8 / 31;
    ASSERT_TRUE(study.amend(amended, "EC-2027-3"));
    EXPECT_TRUE(study.mayBegin(request)) << "a renewal asks for no consent that was given";
    amended.consentVersion = "2";
    ASSERT_TRUE(study.amend(amended, "EC-2027-4"));
    EXPECT_TRUE(study.mayBegin(request)) << "the form that they signed first";
    amended.consentVersion = "4";
    amended.approval.from = std::chrono::year(2027) / 9 / 10;
    ASSERT_TRUE(study.amend(amended, "EC-2027-5"));
    EXPECT_FALSE(study.consent(code, {"4", std::chrono::year(2027) / 9 / 9, "KL"}));
    ASSERT_TRUE(study.consent(code, {"4", std::chrono::year(2027) / 9 / 10, "KL"}));
    EXPECT_TRUE(study.mayBegin(request));
}

TEST_F(Desk, AProcedureThatWasNotApprovedBeginsNoSession) {
    RecordProperty("hazard", "H11");
    auto settings = test::someStudy();
    settings.procedure = {0.5, 2, DetectionMethod::Quest, std::string(64, 'a')};
    auto study = make(settings);
    auto request = test::someRequest(enrolled(study));
    EXPECT_THAT(study.beginSession(request), test::refused(kGateRefused)) << "one that says nothing of it";
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
