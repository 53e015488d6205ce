// What happens once, what a stop does, and what comes before a train.
#include <algorithm>
#include <gmock/gmock.h>

#include "core/pilot/PilotStage.h"
#include "core/session/SessionReader.h"
#include "tests/bench/BenchFixture.h"

namespace tacto {
namespace {

using testing::ElementsAre;

/// Answers with the first target, and stops where it is told to.
class Someone final : public PilotParticipant {
public:
    void show(const PilotScreen& screen) override {
        shown.push_back(screen);
        if (onShow) onShow();
    }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        asked.push_back(prompt.name);
        if (prompt.kind != PromptKind::GoOn && stops > 0) {
            --stops;
            stop(stoppedBy);
            return fail(ErrorCode::Stopped, "stopped by the {}", stoppedBy);
        }
        PilotAnswer answer;
        answer.keys.push_back(prompt.targets.front().key);
        answer.after = Seconds(0.5);
        return answer;
    }
    void delivered(const FeltPresentation& felt) override { drawn.push_back(felt.drawnFor); }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return {}; }
    void cancel() noexcept override {}
    [[nodiscard]] bool holding() const noexcept override { return true; }
    [[nodiscard]] Result<void> ready() const override { return {}; }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return false; }

    std::vector<std::string> asked;
    std::vector<std::string> drawn;
    std::vector<PilotScreen> shown;
    std::function<void()> onShow;
    int stops = 0;
    const char* stoppedBy = "participant";
};

class PilotStageTest : public test::BenchFixture {
protected:
    ~PilotStageTest() override { close(); }
    void SetUp() override {
        profile_.electrodeArea = SquareCentimetres(4);
        person_ = PersonSetup{.participant = "P-7K3M",
                              .consentRecorded = true,
                              .discomfortLimit = Milliamps(30),
                              .rampStep = Milliamps(1)};
        clockOfFile_ = std::make_shared<VirtualClock>();
        begin();
    }
    /// A part of the session with what the earlier ones wrote.
    void begin(const std::vector<SessionRow>& earlier = {}) {
        close();
        ++part_;
        writer_ = SessionWriter::create(file(), {}, *clockOfFile_).value();
        session_ = writer_.get();
        open({"sim:stimulator?mode=current&step=0.5mA"}, {Role::Stimulator});
        ASSERT_TRUE(bench_);
        record_ = std::make_unique<PilotRecord>(*writer_, *clock_, earlier);
        PilotSettings settings;
        settings.code = "P-7K3M";
        settings.isVirtual = true;
        stage_ = std::make_unique<PilotStage>(*bench_, someone_, *record_, settings);
    }
    /// The bench writes to the session until it ends.
    void close() {
        stage_.reset();
        record_.reset();
        bench_.reset();
    }
    [[nodiscard]] std::filesystem::path file() const { return dir_.path() / fmt::format("{}.tacto", part_); }
    [[nodiscard]] std::vector<SessionRow> rows() const { return SessionReader::open(file()).value().events().value(); }
    /// Those of the session's own kinds, in order.
    [[nodiscard]] std::vector<std::string> kinds() const {
        std::vector<std::string> all;
        for (const auto& each : rows()) {
            for (const char* kind : {row::kTrialBegin, row::kAnswer, row::kParticipantStop, row::kContinue,
                                     row::kOperatorStop, row::kSessionEnd})
                if (each.name == kind) all.push_back(each.name);
        }
        return all;
    }
    [[nodiscard]] StageTrial trial(const std::string& name = "test 1", double level = 0.5) const {
        StageTrial made;
        made.name = name;
        made.about = {{"number", 1}, {"phase", "test"}, {"block", 1}, {"condition", "rough-high"}};
        made.level = level;
        made.presentation = ascendingPresentation(Milliamps(level), Seconds(0.5));
        made.prompt = strengthPrompt();
        made.screen.state = ScreenState::Feel;
        return made;
    }

    test::ScratchDir dir_;
    std::shared_ptr<VirtualClock> clockOfFile_;
    int part_ = 0;
    Someone someone_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<PilotRecord> record_;
    std::unique_ptr<PilotStage> stage_;
};

TEST_F(PilotStageTest, EachAnswerIsOnDiskBeforeTheNextTrialBegins) {
    RecordProperty("hazard", "H8");
    for (const char* name : {"test 1", "test 2"}) {
        const auto answer = stage_->trial(trial(name));
        ASSERT_TRUE(answer) << answer.error().message;
        EXPECT_EQ(answer->response, "nothing");
        EXPECT_EQ(answer->attempt, 1U);
    }
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "answer", "trial-begin", "answer"));
    const auto all = rows();
    const auto answered = std::ranges::find(all, row::kAnswer, &SessionRow::name);
    ASSERT_NE(answered, all.end());
    EXPECT_EQ(answered->body["trains"], 3);
    EXPECT_EQ(answered->body["delivered"].size(), 3U);
}

TEST_F(PilotStageTest, WhatHasAnAnswerIsNeitherPresentedNorAskedAgain) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(stage_->trial(trial()));
    const auto felt = someone_.drawn;
    const auto earlier = rows();
    begin(earlier);
    someone_.asked.clear();
    someone_.drawn.clear();
    const auto answer = stage_->trial(trial());
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_TRUE(answer->replayed);
    EXPECT_EQ(answer->response, "nothing");
    EXPECT_TRUE(someone_.asked.empty());
    EXPECT_EQ(someone_.drawn, felt) << "told again, as it was";
    EXPECT_TRUE(kinds().empty());
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(PilotStageTest, TheIntervalsOfADetectionTrialAreMarkedAlikeWhicheverHoldsTheTrain) {
    RecordProperty("hazard", "H9");
    struct Mark {
        int interval;
        double after_s;  // since the first
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
            if (marks.size() <= 1) first_s = now_s;  // from interval 1 on: how long it waited before is drawn
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
    const auto answer = stage_->trial(trial("test 1", 1));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, ErrorCode::ParseError);
}

TEST_F(PilotStageTest, AParticipantsStopVoidsTheTrialWhichIsRepeatedAfterTheirGoOn) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    const auto answer = stage_->trial(trial());
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_EQ(answer->attempt, 2U);
    EXPECT_THAT(someone_.asked, ElementsAre("strength", "go-on", "strength"));
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "participant-stop", "continue", "trial-begin", "answer"));
}

TEST_F(PilotStageTest, TheirThirdStopEndsTheSession) {
    RecordProperty("hazard", "H2");
    someone_.stops = 3;
    const auto answer = stage_->trial(trial());
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, ErrorCode::Stopped);
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
    EXPECT_EQ(kinds().back(), "session-end");
    EXPECT_NE(state(), InterlockState::Armed);
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
        const auto answer = stage_->trial(trial(name, level));
        ASSERT_TRUE(answer) << answer.error().message;
        ASSERT_TRUE(stage_->judged(level, false, name, false));
    }
    const auto earlier = rows();
    begin(earlier);
    for (const double level : {0.5, 1.0, 1.5}) {
        const auto name = fmt::format("ascending {}", level);
        const auto answer = stage_->trial(trial(name, level));
        ASSERT_TRUE(answer) << answer.error().message;
        ASSERT_TRUE(stage_->judged(level, false, name, answer->replayed));
    }
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
    const auto answer = stage_->trial(trial("test 1", 2));
    ASSERT_TRUE(answer) << answer.error().message;
    std::vector<std::string> answered;
    for (const auto& each : rows())
        if (each.name == row::kAnswer) answered.push_back(each.body["name"]);
    EXPECT_THAT(answered, ElementsAre("ramp 0 0.5", "ramp 0 1", "ramp 0 1.5", "test 1"));
}

/// The same stage with a massager, and perhaps a sensor board on its motor.
class VibratedStageTest : public PilotStageTest {
protected:
    void SetUp() override {
        person_ = PersonSetup{.participant = "P-7K3M",
                              .consentRecorded = true,
                              .vibration = PersonVibration{.discomfortLimit = 1, .rampStep = kIntensityStep}};
        clockOfFile_ = std::make_shared<VirtualClock>();
        beginVibrated();
    }
    void beginVibrated(const std::vector<SessionRow>& earlier = {}, std::vector<std::string> uris = {"sim:massager"}) {
        close();
        ++part_;
        writer_ = SessionWriter::create(file(), {}, *clockOfFile_).value();
        session_ = writer_.get();
        open(std::move(uris), {Role::Massager});
        ASSERT_TRUE(bench_);
        record_ = std::make_unique<PilotRecord>(*writer_, *clock_, earlier);
        PilotSettings settings;
        settings.code = "P-7K3M";
        settings.isVirtual = true;
        settings.unit = LevelUnit::Intensity;
        settings.cap = 1;
        stage_ = std::make_unique<PilotStage>(*bench_, someone_, *record_, settings);
    }
    [[nodiscard]] StageTrial vibrated(const std::string& name, int steps) const {
        auto made = trial(name, kIntensityStep * steps);
        made.presentation = ascendingPresentation(VibrationIntensity{kIntensityStep * steps}, Seconds(0.5));
        return made;
    }
    /// Levels of one to `most` steps, each accepted.
    void rise(int most) {
        for (int steps = 1; steps <= most; ++steps) {
            const auto made = vibrated(fmt::format("ascending {}", steps), steps);
            const auto answer = stage_->trial(made);
            ASSERT_TRUE(answer) << answer.error().message;
            ASSERT_TRUE(stage_->judged(made.level, false, made.name, answer->replayed));
        }
    }
};

TEST_F(VibratedStageTest, AResumedSessionReachesItsStrengthsAgainStepByStep) {
    RecordProperty("hazard", "H6");
    rise(3);
    const auto earlier = rows();
    beginVibrated(earlier);
    rise(3);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U) << "what has an answer is not presented again";
    const auto answer = stage_->trial(vibrated("test 1", 4));
    ASSERT_TRUE(answer) << answer.error().message;
    std::vector<std::string> answered;
    for (const auto& each : rows())
        if (each.name == row::kAnswer) answered.push_back(each.body["name"]);
    EXPECT_THAT(answered, ElementsAre("ramp 0 0.05", "ramp 0 0.1", "ramp 0 0.15000000000000002", "test 1"));
}

TEST_F(VibratedStageTest, AStrengthThatWasNotReachedByStepsIsRefused) {
    RecordProperty("hazard", "H6");
    const auto answer = stage_->trial(vibrated("test 1", 2));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, ErrorCode::LimitExceeded);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

TEST_F(VibratedStageTest, TooStrongHoldsFromThenOn) {
    RecordProperty("hazard", "H6");
    rise(3);
    const auto made = vibrated("ascending 4", 4);
    ASSERT_TRUE(stage_->trial(made));
    ASSERT_TRUE(stage_->judged(made.level, true, made.name, false));
    EXPECT_NE(state(), InterlockState::Armed);
    ASSERT_TRUE(stage_->trial(vibrated("test 1", 3)));
    EXPECT_FALSE(stage_->trial(vibrated("test 2", 5)));
}

TEST_F(VibratedStageTest, AParticipantsStopVoidsTheVibration) {
    RecordProperty("hazard", "H2");
    someone_.stops = 1;
    const auto answer = stage_->trial(vibrated("test 1", 1));
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_EQ(answer->attempt, 2U);
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "participant-stop", "continue", "trial-begin", "answer"));
}

TEST_F(VibratedStageTest, WithoutAnAccelerometerNothingIsSaidOfTheMotor) {
    RecordProperty("hazard", "H9");
    const auto answer = stage_->trial(vibrated("test 1", 1));
    ASSERT_TRUE(answer);
    EXPECT_FALSE(answer->vibration);
    for (const auto& each : rows()) EXPECT_FALSE(each.body.contains("vibration")) << each.name;
}

TEST_F(VibratedStageTest, TheBoardOnTheMotorSaysWhatItDidAndTheRowKeepsIt) {
    RecordProperty("hazard", "H9");
    beginVibrated({}, {"sim:massager", "sim:finger?on=motor"});
    rise(6);
    const auto made = vibrated("test 1", 6);
    const auto answer = stage_->trial(made);
    ASSERT_TRUE(answer) << answer.error().message;
    ASSERT_TRUE(answer->vibration);
    EXPECT_EQ(answer->vibration->moved, 3U);
    EXPECT_EQ(answer->vibration->missed, 0U);
    EXPECT_NEAR(answer->vibration->interval_s, 0.5, 0.02);
    EXPECT_GT(answer->vibration->strength_m_s2, 0.1);
    EXPECT_LT(answer->vibration->strength_m_s2, 15 * 0.3 * 0.3) << "no more than at full speed";
    EXPECT_GT(answer->vibration->latency_s, 0);
    const auto earlier = rows();
    beginVibrated(earlier);
    const auto again = stage_->trial(made);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_TRUE(again->replayed);
    ASSERT_TRUE(again->vibration);
    EXPECT_EQ(again->vibration->strength_m_s2, answer->vibration->strength_m_s2);
}

TEST_F(VibratedStageTest, NothingListensOnceAPresentationHasEndedHoweverItDid) {
    RecordProperty("hazard", "H2");
    beginVibrated({}, {"sim:massager", "sim:finger?on=motor"});
    ASSERT_FALSE(stage_->trial(vibrated("test 1", 2))) << "refused by the ramp rule";
    someone_.stops = 1;
    someone_.stoppedBy = "operator";
    ASSERT_FALSE(stage_->trial(vibrated("test 1", 1)));
    stage_.reset();  // a tap that was still listened to would be gone
    bench_->idle(Seconds(1));
    bench_.reset();
}

TEST_F(VibratedStageTest, AMotorThatDoesNotMoveIsSeenAndIsNoZero) {
    RecordProperty("hazard", "H9");
    beginVibrated({}, {"sim:massager?acceleration=0.1m/s2", "sim:finger?on=motor"});
    const auto answer = stage_->trial(vibrated("test 1", 1));
    ASSERT_TRUE(answer) << answer.error().message;
    ASSERT_TRUE(answer->vibration);
    EXPECT_EQ(answer->vibration->moved, 0U);
    EXPECT_TRUE(std::isnan(answer->vibration->strength_m_s2));
}

}  // namespace
}  // namespace tacto
