// The gates that only the running bench can ask.
#include "core/pilot/PilotCare.h"
#include "core/pilot/PilotSession.h"
#include "tests/pilot/StageFixture.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

class PilotCareTest : public PilotStageTest {
protected:
    [[nodiscard]] std::vector<nlohmann::json> bodies(const char* kind) const {
        std::vector<nlohmann::json> all;
        for (const auto& each : rows())
            if (each.name == kind) all.push_back(each.body);
        return all;
    }
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
    const auto passed = care.checklist();
    ASSERT_TRUE(passed) << passed.error().message;
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(2));
    std::vector<std::string> confirmed;
    for (std::size_t i = 0; i < someone_.asked.size(); ++i)
        if (someone_.asked[i] == "arm") confirmed.push_back(someone_.texts[i]);
    const auto name = bench_->armingText(parseLoad(ArmRequest().load).value());
    EXPECT_THAT(confirmed, SizeIs(4)) << "two tests of STOP, two checks of the electrodes";
    EXPECT_THAT(confirmed, Each(HasSubstr(name)));
    EXPECT_THAT(confirmed, Contains(HasSubstr("Measure the electrodes with")));
}

TEST_F(PilotCareTest, TheOthersStopProvesNothingAndItIsAskedAgain) {
    RecordProperty("hazard", "H2");
    PilotCare care(*stage_);
    someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    someone_.testPresses = 2;  // the participant's, who is asked, and once more when the operator is asked
    const auto passed = care.checklist();
    ASSERT_TRUE(passed) << passed.error().message;
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
    const auto passed = care.checklist();
    ASSERT_FALSE(passed);
    EXPECT_THAT(passed.error().message, HasSubstr("in the test of the participant's STOP the operator's was pressed"));
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
    // As if it had died when it asked for the skin afterwards.
    std::vector<SessionRow> earlier;
    for (const auto& each : rows()) {
        earlier.push_back(each);
        if (each.name == row::kSessionEnd) break;
    }
    begin(earlier);
    PilotSession session(*bench_, someone_, *record_, PilotSettings{}, nullptr, 2);
    session.resumesFrom("part 1", "head");
    const auto begun = session.begin(false);
    ASSERT_FALSE(begun);
    EXPECT_THAT(begun.error().message, HasSubstr("the skin scores 2 (break 3)"));
    EXPECT_EQ(session.stage().ended(), PilotEnd::Stopped);
    EXPECT_THAT(bodies(row::kSkin), SizeIs(2)) << "of afterwards";
    EXPECT_THAT(bodies(row::kStopTest), SizeIs(0)) << "nothing is armed";
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
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
    const auto passed = care.checklist();
    ASSERT_FALSE(passed);
    EXPECT_THAT(passed.error().message, HasSubstr("the skin scores 1 (before); at most 0 is accepted"));
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
    const auto answer = stage_->trial(trial());
    ASSERT_FALSE(answer);
    EXPECT_THAT(answer.error().message, HasSubstr("after 100 ohm; a change of at most 30 % is accepted"));
    EXPECT_THAT(bodies(row::kImpedance), SizeIs(4)) << "that of the test, and three seatings";
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
}

}  // namespace
}  // namespace tacto::test
