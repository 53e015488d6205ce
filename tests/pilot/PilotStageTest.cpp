// Nothing with an answer happens twice; what a stop does; what happens before a train.
#include "tests/pilot/StageFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

TEST_F(PilotStageTest, EachAnswerIsOnDiskBeforeTheNextTrialBegins) {
    RecordProperty("hazard", "H8");
    for (const char* name : {"test 1", "test 2"}) {
        const auto answer = accepted(stage_->trial(trial(name)));
        EXPECT_EQ(answer.response, "nothing");
        EXPECT_EQ(answer.attempt, 1U);
    }
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "answer", "trial-begin", "answer"));
    const auto all = rows();
    const auto answered = std::ranges::find(all, row::kAnswer, &SessionRow::name);
    ASSERT_NE(answered, all.end());
    EXPECT_EQ(answered->body["trains"], 3);
    EXPECT_EQ(answered->body["delivered"].size(), 3U);
}

TEST_F(PilotStageTest, TheNextTrainComesTwoToThreeSecondsAfterAnAnswer) {
    RecordProperty("hazard", "H9");
    std::set<double> pauses;
    for (int number = 1; number <= 6; ++number) ASSERT_TRUE(stage_->trial(trial(fmt::format("test {}", number))));
    std::optional<double> answered_s;
    for (const auto& each : rows()) {
        if (each.name != row::kAnswer) continue;
        const double first_s = each.body["delivered"][0]["onset_s"];
        if (answered_s) {
            EXPECT_GE(first_s - *answered_s, 2);
            EXPECT_LE(first_s - *answered_s, 3.05);
            pauses.insert(std::round(1000 * (first_s - *answered_s)));
        }
        answered_s = toSeconds(each.at);
    }
    EXPECT_GE(pauses.size(), 4U) << "when it comes cannot be foreseen";
}

TEST_F(PilotStageTest, WhatHasAnAnswerIsNeitherPresentedNorAskedAgain) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(stage_->trial(trial()));
    const auto felt = someone_.drawn;
    const auto earlier = rows();
    begin(earlier);
    someone_.asked.clear();
    someone_.drawn.clear();
    const auto answer = accepted(stage_->trial(trial()));
    EXPECT_TRUE(answer.replayed);
    EXPECT_EQ(answer.response, "nothing");
    EXPECT_TRUE(someone_.asked.empty());
    EXPECT_EQ(someone_.drawn, felt) << "told again, as it was";
    EXPECT_TRUE(kinds().empty());
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(PilotStageTest, TheIntervalsOfADetectionTrialAreMarkedAlikeWhicheverHoldsTheTrain) {
    RecordProperty("hazard", "H9");
    struct Mark {
        int interval;
        double after_s;  // since the first mark
        bool operator==(const Mark&) const = default;
    };
    std::vector<std::vector<Mark>> seen;
    for (const bool second : {false, true}) {
        auto made = trial(second ? "detection 2" : "detection 1");
        made.presentation = detectionPresentation(Milliamps(0.5), second, Seconds(0.001), Seconds(0.5));
        made.prompt = intervalPrompt();
        made.screen.state = ScreenState::Interval;
        std::vector<Mark> marks;
        double first_s = 0;
        someone_.onShow = [&] {
            const auto& screen = someone_.shown.back();
            if (screen.state != ScreenState::Interval) return;
            const double now_s = toSeconds(clock_->now());
            if (marks.size() <= 1) first_s = now_s;  // the wait before interval 1 is random
            marks.push_back({screen.interval, marks.empty() ? 0 : now_s - first_s});
        };
        ASSERT_TRUE(stage_->trial(made));
        someone_.onShow = nullptr;
        seen.push_back(std::move(marks));
    }
    for (const auto& marks : seen) {
        ASSERT_EQ(marks.size(), 4U);
        EXPECT_EQ(marks[0].interval, 0) << "before it begins";
        EXPECT_EQ(marks[1].interval, 1);
        EXPECT_EQ(marks[2].interval, 0) << "between";
        EXPECT_NEAR(marks[2].after_s, 0.8, 0.01);
        EXPECT_EQ(marks[3].interval, 2);
        EXPECT_NEAR(marks[3].after_s, 1.4, 0.01);
    }
}

TEST_F(PilotStageTest, NoIntervalIsMarkedAfterAStop) {
    RecordProperty("hazard", "H2");
    auto made = trial("detection 1");
    made.presentation = detectionPresentation(Milliamps(0.5), true, Seconds(0.001), Seconds(0.5));
    made.prompt = intervalPrompt();
    made.screen.state = ScreenState::Interval;
    bool stopped = false;
    std::vector<int> after;
    someone_.onShow = [&] {
        const auto& screen = someone_.shown.back();
        if (screen.state != ScreenState::Interval) return;
        if (stopped) after.push_back(screen.interval);
        if (!stopped && screen.interval == 1) {
            stopped = true;
            someone_.stop("operator");
        }
    };
    EXPECT_FALSE(stage_->trial(made));
    EXPECT_TRUE(stopped);
    EXPECT_TRUE(after.empty());
}

TEST_F(PilotStageTest, AnAnswerToAnotherLevelIsNotTaken) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(stage_->trial(trial()));
    const auto earlier = rows();
    begin(earlier);
    EXPECT_THAT(stage_->trial(trial("test 1", 1)), test::refused(ErrorCode::ParseError));
}

TEST_F(PilotStageTest, AnAnswerBesideAnotherWeakerLevelIsNotTaken) {
    RecordProperty("hazard", "H9");
    auto compared = trial();
    for (const double weaker : {0.0, 0.25}) {
        compared.weaker = weaker;
        begin({});
        ASSERT_TRUE(stage_->trial(compared));
        const auto earlier = rows();
        begin(earlier);
        compared.weaker = 0.5;
        EXPECT_THAT(stage_->trial(compared), test::refused(ErrorCode::ParseError, "beside"));
    }
}

TEST_F(PilotStageTest, AnAnswerToAnotherIntervalIsNotTaken) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(stage_->trial(trial()));
    const auto earlier = rows();
    begin(earlier);
    auto other = trial();
    other.presentation = ascendingPresentation(Milliamps(0.5), Seconds(0.6));
    EXPECT_THAT(stage_->trial(other), test::refused(ErrorCode::ParseError, "at an interval of 0.5 s"));
}

TEST_F(PilotStageTest, AParticipantsStopVoidsTheTrialWhichIsRepeatedAfterTheirGoOn) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    const auto answer = accepted(stage_->trial(trial()));
    EXPECT_EQ(answer.attempt, 2U);
    EXPECT_THAT(someone_.asked, ElementsAre("strength", "go-on", "strength"));
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "participant-stop", "continue", "trial-begin", "answer"));
}

TEST_F(PilotStageTest, TheirThirdStopEndsTheSession) {
    RecordProperty("hazard", "H2");
    someone_.stops = 3;
    EXPECT_THAT(stage_->trial(trial()), test::refused(ErrorCode::Stopped));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(kinds().back(), "session-end");
    EXPECT_NE(state(), InterlockState::Armed);
}

TEST_F(PilotStageTest, AContactThatBouncesSwitchesOffAndIsNoneOfTheirStops) {
    RecordProperty("hazard", "H2");
    someone_.stoppedBy = kParticipantLetGo;
    someone_.stops = 5;
    someone_.bounces = true;
    int off = 0;
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.kind != PromptKind::GoOn) return;
        ++off;
        EXPECT_NE(state(), InterlockState::Armed) << "it is off until they go on";
        someone_.bounces = off < 5;
    };
    accepted(stage_->trial(trial()));
    EXPECT_EQ(off, 5);
    EXPECT_EQ(record_->count(row::kParticipantStop), 0U);
    EXPECT_EQ(record_->count(row::kPause), 5U);
    EXPECT_EQ(record_->begun("test 1"), 6U) << "each presentation was void";
    for (const auto& row : rows()) {
        if (row.name != row::kPause) continue;
        EXPECT_EQ(row.body["why"], "the contact of the button that is held bounced");
    }

    // A stop that was not a bounce is a normal stop, and the third stop ends the session.
    someone_.onAsk = {};
    someone_.stops = 3;
    EXPECT_FALSE(stage_->trial(trial("test 2")));
    EXPECT_EQ(record_->count(row::kParticipantStop), 3U);
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
}

TEST_F(PilotStageTest, AStopThatIsPressedIsNoBounceWhateverItsContactDoes) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    someone_.bounces = true;  // the contact of another button bounces
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_EQ(record_->count(row::kParticipantStop), 1U);
    EXPECT_EQ(record_->count(row::kPause), 0U);
}

TEST_F(PilotStageTest, ASecondPressWhileNothingIsOnCountsAndTheyAreAskedAgain) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    someone_.stopsAtGoOn = 1;
    accepted(stage_->trial(trial()));
    EXPECT_THAT(someone_.asked, ElementsAre("strength", "go-on", "go-on", "strength"));
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "participant-stop", "participant-stop", "continue", "trial-begin",
                                     "answer"));
}

TEST_F(PilotStageTest, ThreePressesOfStopEndTheSessionWhereverTheyCome) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    someone_.stopsAtGoOn = 2;
    EXPECT_FALSE(stage_->trial(trial()));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 3U) << "those of the one presentation";
}

TEST_F(PilotStageTest, RisingLevelsAreNotPresentedWhileTheParticipantDoesNotHold) {
    RecordProperty("hazard", "H6");
    auto rising = trial("ascending 1");
    rising.held = true;
    someone_.holds = false;
    someone_.letsGo = true;
    someone_.stops = 1;  // a stop at the prompt that asks the participant to hold
    const auto answer = accepted(stage_->trial(rising));
    EXPECT_THAT(someone_.asked, ElementsAre("hold", "go-on", "hold", "strength"));
    EXPECT_EQ(answer.attempt, 1U) << "nothing had been presented";
}

/// A session in which 0.5 and 1 mA were accepted; then an electrode lifts at 20 s, for 10 s.
class PilotStageFaultTest : public PilotStageTest {
protected:
    void reachOne(const std::string& fault) {
        more_ = "&fault=" + fault;
        begin();
        someone_.letsGo = true;
        someone_.holds = false;
        ASSERT_NO_FATAL_FAILURE(acceptOne());
        stage_->onSeatedAgain([this]() -> Result<void> {
            ++measured_;
            EXPECT_NE(state(), InterlockState::Armed);
            return {};
        });
        someone_.asked.clear();
        operatorTakesTime();
    }
    void passUntil(double s) { ASSERT_TRUE(stage_->pass(Seconds(s - toSeconds(clock_->now())))); }
    int measured_ = 0;
};

TEST_F(PilotStageFaultTest, TheyHoldAgainAndTheLevelsAreReachedAgainStepByStep) {
    RecordProperty("hazard", "H3");
    reachOne("open@20.2s..24s");
    passUntil(19);
    const auto answer = accepted(stage_->trial(rising(1.5)));
    EXPECT_EQ(answer.response, "nothing") << "a fault is not a stop of the participant";
    EXPECT_EQ(record_->count(row::kFault), 1U);
    EXPECT_EQ(measured_, 1);
    EXPECT_THAT(answered(), ElementsAre("ascending 0.5", "ascending 1", "ramp 0 0.5", "ramp 0 1", "ascending 1.5"));
    EXPECT_THAT(someone_.asked, ElementsAre("go-on", "go-on", "hold", "strength", "strength", "hold", "strength"))
        << "the operator, then the participant";
}

TEST_F(PilotStageFaultTest, AStimulatorThatAnswersTooLateIsOneToo) {
    RecordProperty("hazard", "H2");
    reachOne("late@20.2s..24s");
    passUntil(19);
    accepted(stage_->trial(rising(1.5)));
    EXPECT_EQ(record_->count(row::kFault), 1U);
    EXPECT_EQ(measured_, 1);
}

TEST_F(PilotStageFaultTest, ASecondOneEndsTheSession) {
    RecordProperty("hazard", "H3");
    reachOne("open@20.2s..24s&fault=open@120s");
    passUntil(19);
    ASSERT_TRUE(stage_->trial(rising(1.5)));
    ASSERT_LT(toSeconds(clock_->now()), 110);
    passUntil(118.9);
    EXPECT_FALSE(stage_->trial(rising(1.5)) && stage_->trial(rising(2)));
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(record_->count(row::kFault), 2U);
}

TEST_F(PilotStageFaultTest, AnElectrodeThatIsOpenWhenArmingIsSeatedAgainAndIsNoFault) {
    RecordProperty("hazard", "H3");
    reachOne("open@20s..25s");
    stage_->rest();
    passUntil(21);
    accepted(stage_->trial(rising(1.5)));
    EXPECT_EQ(record_->count(row::kFault), 0U);
    EXPECT_GE(measured_, 1);
    EXPECT_THAT(answered(), ElementsAre("ascending 0.5", "ascending 1", "ramp 0 0.5", "ramp 0 1", "ascending 1.5"));
}

TEST_F(PilotStageFaultTest, OneThatLastsIsNotAskedAboutForEver) {
    RecordProperty("hazard", "H3");
    reachOne("unplug@20.2s");
    passUntil(19);
    someone_.asked.clear();
    EXPECT_FALSE(stage_->trial(rising(1.5)));
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished) << "it may be resumed";
    EXPECT_EQ(std::ranges::count(someone_.asked, "go-on"), 3);
}

TEST_F(PilotStageTest, AStopInASeriesIsReplayedAsTheStopThatItWas) {
    RecordProperty("hazard", "H8");
    auto made = trial("ascending 1", 0.5);
    made.stopAnswers = true;
    someone_.stops = 1;
    const auto answer = accepted(stage_->trial(made));
    EXPECT_EQ(answer.response, "stop");
    const auto stimulated = stage_->stimulated();
    const auto earlier = rows();
    begin(earlier);
    const auto again = accepted(stage_->trial(made));
    EXPECT_EQ(again.response, "stop");
    EXPECT_TRUE(again.replayed);
    EXPECT_EQ(stage_->stimulated(), stimulated);
}

TEST_F(PilotStageFaultTest, OneThatStaysOpenBreaksTheSessionOff) {
    RecordProperty("hazard", "H3");
    reachOne("open@20s");
    stage_->rest();
    passUntil(21);
    EXPECT_THAT(stage_->trial(rising(1.5)), test::refused(ErrorCode::NotArmed));
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished) << "it may be resumed";
}

TEST_F(PilotStageTest, AnOperatorsStopBreaksTheSessionOff) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    someone_.stoppedBy = "operator";
    const auto answer = stage_->trial(trial());
    ASSERT_FALSE(answer);
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished);
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "operator-stop"));
    EXPECT_NE(state(), InterlockState::Armed);
}

TEST_F(PilotStageTest, ARowThatCannotBeWrittenComesBeforeTheTrain) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(stage_->ready());
    const auto before = bench_->telemetry().trainsDelivered;
    ASSERT_TRUE(writer_->close());
    const auto answer = stage_->trial(trial());
    ASSERT_FALSE(answer);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, before);
    EXPECT_TRUE(someone_.asked.empty());
}

TEST_F(PilotStageTest, AResumedSessionReachesItsLevelsAgainStepByStep) {
    RecordProperty("hazard", "H6");
    for (const double level : {0.5, 1.0, 1.5}) {
        const auto name = fmt::format("ascending {}", level);
        accepted(stage_->trial(trial(name, level)));
        ASSERT_TRUE(stage_->judged(level, false, name, false));
    }
    const auto earlier = rows();
    begin(earlier);
    for (const double level : {0.5, 1.0, 1.5}) {
        const auto name = fmt::format("ascending {}", level);
        const auto answer = accepted(stage_->trial(trial(name, level)));
        ASSERT_TRUE(stage_->judged(level, false, name, answer.replayed));
    }
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
    accepted(stage_->trial(trial("test 1", 2)));
    EXPECT_THAT(answered(), ElementsAre("ramp 0 0.5", "ramp 0 1", "ramp 0 1.5", "test 1"));
}

}  // namespace
}  // namespace tacto::test
