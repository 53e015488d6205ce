// Tests the gates that only the running bench can check.
#include "core/pilot/PilotCare.h"
#include "core/pilot/PilotSession.h"
#include "tests/pilot/StageFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

class PilotCareTest : public PilotStageTest {
protected:
    void openReal() {
        looksReal_ = true;
        calibration_ = StimulatorCalibration{{1, 0, 0.5, 50},
                                             CalibrationLine{1, 0, 0.01, 10},
                                             CalibrationLine{1, 0, 10e-6, 1e-3},
                                             CalibrationLine{1, 0, 10e-6, 1e-3}};
        begin();
    }
};

TEST_F(PilotCareTest, ARealStimulatorPassesTheChecklistAndTheOperatorConfirmsItByNameEachTime) {
    RecordProperty("hazard", "H11");
    openReal();
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    accepted(care.checklist());
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(2));
    std::vector<std::string> confirmed;
    for (std::size_t i = 0; i < someone_.asked.size(); ++i)
        if (someone_.asked[i] == "arm") confirmed.push_back(someone_.texts[i]);
    const auto name = bench_->armingText(parseLoad(ArmRequest().load).value());
    EXPECT_THAT(confirmed, SizeIs(4)) << "two tests of STOP, two checks of the electrodes";
    EXPECT_THAT(confirmed, Each(HasSubstr(name)));
    EXPECT_THAT(confirmed, Contains(HasSubstr("Measure the electrodes with")));
}

TEST_F(PilotCareTest, AStopOfTheRunWhileAStopIsTestedIsNoTestAndNothingGoesOnAfterIt) {
    RecordProperty("hazard", "H2");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    someone_.onAsk = [this](const PilotPrompt& prompt) {
        if (prompt.name != "stop-test") return;
        stage_->endRun();
        bench_->stop("operator (STOP)");  // next, the participant presses STOP as asked
    };
    EXPECT_THAT(care.checklist(), test::refused(ErrorCode::Stopped));
    EXPECT_EQ(someone_.asked.back(), "stop-test") << "no one is asked to go on";
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(0)) << "no pulse after the stop";
    EXPECT_FALSE(stage_->isArmed());
}

TEST_F(PilotCareTest, TheOthersStopProvesNothingAndItIsAskedAgain) {
    RecordProperty("hazard", "H2");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    someone_.testPresses = 2;  // the participant presses once when asked, and once more when the operator is asked
    accepted(care.checklist());
    const auto tests = bodies(row::kStopTest);
    ASSERT_THAT(tests, SizeIs(3));
    EXPECT_EQ(tests[0]["by"], "participant");
    EXPECT_EQ(tests[0]["pressed"], true);
    EXPECT_EQ(tests[1]["by"], "operator");
    EXPECT_EQ(tests[1]["pressed"], false);
    EXPECT_EQ(tests[1]["other"], "participant");
    EXPECT_EQ(tests[2]["pressed"], true);
}

TEST_F(PilotCareTest, WhereOnlyTheOtherOneIsPressedThereIsNoSession) {
    RecordProperty("hazard", "H2");
    PilotCare care(*stage_);
    someone_.testPresses = 100;
    someone_.testedBy = "operator";
    EXPECT_THAT(care.checklist(),
                test::refusedSaying("in the test of the participant's STOP the operator's was pressed"));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(PilotCareTest, ASkinThatReactsIsReportedAndEndsTheSession) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    std::vector<std::string> reported;
    care.skinReacted = [&](const std::string& moment, int score) -> Result<void> {
        reported.push_back(fmt::format("{} {}", moment, score));
        return {};
    };
    someone_.answers = {{"erythema", "1"}, {"oedema", "0"}};
    EXPECT_TRUE(care.skin("break 3")) << "1 is accepted";
    someone_.answers = {{"erythema", "1"}, {"oedema", "3"}};
    EXPECT_FALSE(care.skin("after"));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(reported, std::vector<std::string>{"after 3"});
    ASSERT_THAT(bodies(row::kAdverseEvent), SizeIs(1));
}

TEST_F(PilotCareTest, ASessionThatTheParticipantEndsAsksForSkinAndSideEffects) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "1"}, {"oedema", "0"}};
    someone_.stops = 1;
    someone_.stopsAtGoOn = 2;
    EXPECT_FALSE(stage_->trial(trial()));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_THAT(bodies(row::kSkin), SizeIs(2));
    EXPECT_THAT(bodies(row::kSideEffect), SizeIs(testing::Ge(1U)));
    EXPECT_THAT(bodies(row::kSessionEnd), SizeIs(1));
}

TEST_F(PilotCareTest, ABreakThatIsWantedAfterItsEndSkipsNoQuestion) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "1"}, {"oedema", "0"}};
    someone_.stops = 1;
    someone_.stopsAtGoOn = 2;
    bool pressed = false;
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name != "erythema" || stage_->ended() == PilotEnd::Unfinished || std::exchange(pressed, true))
            return;
        someone_.stops = 1;
        someone_.stoppedBy = kOperatorPauses;
    };
    EXPECT_FALSE(stage_->trial(trial()));
    EXPECT_TRUE(pressed);
    EXPECT_THAT(bodies(row::kSkin), SizeIs(2));
    EXPECT_THAT(bodies(row::kSideEffect), SizeIs(testing::Ge(1U)));
}

TEST_F(PilotCareTest, AThirdStopDuringAPresentationIsFollowedByTheQuestionsToo) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    someone_.onShow = [this] {
        if (someone_.shown.back().state == ScreenState::Feel) someone_.press("participant");
    };
    EXPECT_FALSE(stage_->trial(trial()));
    EXPECT_EQ(record_->count(row::kParticipantStop), 3U);
    EXPECT_EQ(record_->count(row::kOperatorStop), 0U);
    EXPECT_THAT(bodies(row::kSkin), SizeIs(2));
    EXPECT_THAT(bodies(row::kSideEffect), SizeIs(testing::Ge(1U)));
}

TEST_F(PilotCareTest, ASessionThatWasStoppedGoesOnWithNothingButItsQuestions) {
    RecordProperty("hazard", "H12");
    {
        PilotCare care(*stage_);
        ASSERT_TRUE(stage_->trial(trial()));
        someone_.answers = {{"erythema", "2"}, {"oedema", "0"}};
        EXPECT_FALSE(care.skin("break 3"));
    }
    // Begins as if the program had died when it asked for the skin after the session.
    begin(rowsUntil(row::kSessionEnd));
    PilotSession session(*bench_, someone_, *record_, PilotSettings{}, nullptr, 2);
    session.resumesFrom("part 1", "head");
    EXPECT_THAT(session.begin(false), test::refusedSaying("the skin scores 2 (break 3)"));
    EXPECT_EQ(session.stage().ended(), PilotEnd::Stopped);
    EXPECT_THAT(bodies(row::kSkin), SizeIs(2)) << "of afterwards";
    EXPECT_THAT(bodies(row::kStopTest), SizeIs(0)) << "nothing is armed";
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(PilotCareTest, AStopRightAfterATestOfItIsOneAndIsHandled) {
    RecordProperty("hazard", "H2");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    record_->onWritten = [this](std::size_t) {
        if (record_->count(row::kStopTest) != 1) return;
        record_->onWritten = {};
        someone_.stop("participant");
    };
    accepted(care.checklist());
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
    EXPECT_THAT(someone_.asked, Contains("go-on")) << "nothing resumes without them";
}

/// The rows on disk if the program was killed before it wrote the session's end.
struct Killed {
    const char* name;
    std::vector<std::pair<const char*, nlohmann::json>> rows;
    const char* says;
};

class EndedByItsRowsTest : public PilotCareTest, public testing::WithParamInterface<Killed> {
protected:
    [[nodiscard]] static std::vector<SessionRow> rowsOf(const Killed& killed) {
        std::vector<SessionRow> all;
        for (const auto& [kind, body] : killed.rows) {
            SessionRow row;
            row.name = kind;
            row.body = body;
            all.push_back(row);
        }
        return all;
    }
};

TEST_P(EndedByItsRowsTest, IsNotTriedAgain) {
    RecordProperty("hazard", "H12");
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    begin(rowsOf(GetParam()));
    PilotSession session(*bench_, someone_, *record_, PilotSettings{}, nullptr, 2);
    session.resumesFrom("part 1", "head");
    EXPECT_THAT(session.begin(false), test::refusedSaying(GetParam().says));
    EXPECT_EQ(session.stage().ended(), PilotEnd::Stopped);
    EXPECT_THAT(bodies(row::kStopTest), SizeIs(0)) << "nothing is armed";
    ASSERT_THAT(bodies(row::kSessionEnd), SizeIs(1));
    EXPECT_EQ(bodies(row::kSessionEnd)[0]["state"], "stopped");
}

INSTANTIATE_TEST_SUITE_P(
    Pilot, EndedByItsRowsTest,
    testing::Values(
        Killed{"TheThirdStop",
               {{row::kParticipantStop, {{"name", "test 1"}}},
                {row::kParticipantStop, {{"name", "go on"}}},
                {row::kParticipantStop, {{"name", "test 1"}}}},
               "for the third time"},
        Killed{"TheSecondFault",
               {{row::kFault, {{"name", "test 1"}}}, {row::kFault, {{"name", "test 1"}}}},
               "a second fault"},
        Killed{"AGate",
               {{row::kGate,
                 {{"name", "block 2 impedance"}, {"holds", false}, {"said", "the electrodes moved"}, {"ends", true}}}},
               "the electrodes moved"},
        Killed{"ANo",
               {{row::kGate,
                 {{"name", "part 1 electrodes"}, {"key", "no"}, {"said", "they were touched"}, {"ends", true}}}},
               "they were touched"},
        Killed{"ARampThatIsTooStrong",
               {{row::kAnswer, {{"name", "ramp 0 1.5"}, {"ramp", true}, {"response", "too-strong"}}}},
               "too strong now"}),
    [](const auto& each) { return each.param.name; });

TEST_F(PilotCareTest, TheRowsThatEndASessionSaySo) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "3"}, {"oedema", "0"}};
    ASSERT_FALSE(care.skin("after"));
    EXPECT_THAT(endedBy(*record_), HasSubstr("the skin scores 3"));
}

TEST_F(PilotCareTest, WhatIsCompleteIsReplayedAndNothingIsAskedOrArmed) {
    RecordProperty("hazard", "H12");
    SessionRow ended;
    ended.name = row::kSessionEnd;
    ended.body = {{"name", row::kEnd}, {"state", "complete"}, {"why", "complete"}};
    begin({ended});
    PilotSession session(*bench_, someone_, *record_, PilotSettings{}, nullptr, 2);
    accepted(session.begin(false));
    EXPECT_TRUE(someone_.asked.empty());
    EXPECT_THAT(session.stage().ready(), test::refused(ErrorCode::Stopped));
    EXPECT_FALSE(session.stage().measureImpedance("part 2 first"));
    ASSERT_TRUE(session.stage().end(PilotEnd::Complete, "complete"));
    EXPECT_THAT(bodies(row::kSessionEnd), SizeIs(0)) << "the earlier part has it";
    EXPECT_EQ(session.stage().ended(), PilotEnd::Complete);
}

TEST_F(PilotCareTest, ElectrodesThatWereNeverMeasuredAreNotAskedAfter) {
    RecordProperty("hazard", "H3");
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}, {"electrodes-untouched", "no"}};
    SessionRow planned;
    planned.name = row::kPlan;
    planned.body = {{"name", "plan"}};
    begin({planned});
    PilotCare care(*stage_);
    accepted(care.checklist());
    EXPECT_THAT(someone_.asked, testing::Not(Contains("electrodes-untouched")));
}

TEST_F(PilotCareTest, AfterABreakNothingIsArmedBeforeTheElectrodesAreMeasured) {
    RecordProperty("hazard", "H3");
    PilotSession session(*bench_, someone_, *record_, PilotSettings{}, nullptr, 1);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    ASSERT_TRUE(session.begin(false));
    ASSERT_TRUE(session.identification().takeBreak(1, Seconds(60)));
    const auto measured = record_->count(row::kImpedance);
    ASSERT_TRUE(bench_->devices().load->fitLoad("1600 ohm"));
    EXPECT_THAT(session.stage().ready(), test::refusedSaying("a change of at most 30 % is accepted"))
        << "a script need not ask for it";
    EXPECT_EQ(record_->count(row::kImpedance), measured + 3) << "three seatings";
    EXPECT_EQ(session.stage().ended(), PilotEnd::Stopped);
}

TEST_F(PilotCareTest, WhatCouldNotBeAskedAfterwardsIsANote) {
    RecordProperty("hazard", "H12");
    ASSERT_TRUE(stage_->trial(trial()));
    stage_->afterCare = []() -> Result<void> { return fail(ErrorCode::Device, "the screen is gone"); };
    EXPECT_FALSE(stage_->end(PilotEnd::Stopped, "stopped"));
    ASSERT_THAT(bodies(row::kNote), SizeIs(1));
    EXPECT_EQ(bodies(row::kNote)[0]["not_asked"], "the screen is gone");
}

TEST_F(PilotCareTest, ASkinThatEndsItLeavesTheSideEffectsToBeAsked) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    ASSERT_TRUE(stage_->trial(trial()));
    someone_.answers = {{"erythema", "2"}, {"oedema", "0"}};
    EXPECT_FALSE(care.skin("after"));
    EXPECT_THAT(bodies(row::kSideEffect), SizeIs(testing::Ge(1U)));
    EXPECT_THAT(bodies(row::kSessionEnd), SizeIs(1));
}

TEST_F(PilotCareTest, WhereNothingWasPresentedNobodyIsAskedAfterwards) {
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "1"}, {"oedema", "0"}};
    ASSERT_FALSE(care.checklist());
    EXPECT_THAT(bodies(row::kSideEffect), SizeIs(0));
}

TEST_F(PilotCareTest, ASkinThatIsRedBeforeBeginsNothing) {
    RecordProperty("hazard", "H12");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "1"}, {"oedema", "0"}};
    EXPECT_THAT(care.checklist(), test::refusedSaying("the skin scores 1 (before); at most 0 is accepted"));
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(0));
}

TEST_F(PilotCareTest, ElectrodesThatMeasureOtherwiseAfterAFaultEndTheSession) {
    RecordProperty("hazard", "H3");
    more_ = "&fault=open@20.2s..21s";
    begin();
    PilotCare care(*stage_);
    ASSERT_TRUE(record_->write(row::kImpedance, "part 1 second", {{"impedance_ohm", 100}}));
    operatorTakesTime();
    ASSERT_TRUE(stage_->pass(Seconds(19)));
    EXPECT_THAT(stage_->trial(trial()), test::refusedSaying("after 100 ohm; a change of at most 30 % is accepted"));
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(4)) << "that of the test, and three seatings";
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
}

}  // namespace
}  // namespace tacto::test
