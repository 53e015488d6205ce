// The stage with a massager: intensities rise in steps, and the measured vibration is kept.
#include "tests/pilot/StageFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

/// A stage with a massager, with or without a sensor board on the motor.
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
        settings.basis = SessionBasis::Virtual;
        settings.unit = LevelUnit::Intensity;
        settings.cap = 1;
        stage_ = std::make_unique<PilotStage>(*bench_, someone_, *record_, settings);
    }
    [[nodiscard]] StageTrial vibrated(const std::string& name, int steps) const {
        auto made = trial(name, kIntensityStep * steps);
        made.presentation = ascendingPresentation(VibrationIntensity{kIntensityStep * steps}, Seconds(0.5));
        return made;
    }
    /// Presents and accepts levels of 1 to `most` steps.
    void rise(int most) {
        for (int steps = 1; steps <= most; ++steps) {
            const auto made = vibrated(fmt::format("ascending {}", steps), steps);
            const auto answer = accepted(stage_->trial(made));
            ASSERT_TRUE(stage_->judged(made.level, false, made.name, answer.replayed));
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
    accepted(stage_->trial(vibrated("test 1", 4)));
    EXPECT_THAT(answered(), ElementsAre("ramp 0 0.05", "ramp 0 0.1", "ramp 0 0.15000000000000002", "test 1"));
}

TEST_F(VibratedStageTest, AStrengthThatWasNotReachedByStepsIsRefused) {
    RecordProperty("hazard", "H6");
    EXPECT_THAT(stage_->trial(vibrated("test 1", 2)), test::refused(ErrorCode::LimitExceeded));
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
    const auto answer = accepted(stage_->trial(vibrated("test 1", 1)));
    EXPECT_EQ(answer.attempt, 2U);
    EXPECT_THAT(kinds(), ElementsAre("trial-begin", "participant-stop", "continue", "trial-begin", "answer"));
}

TEST_F(VibratedStageTest, WithoutAnAccelerometerNothingIsSaidOfTheMotor) {
    RecordProperty("hazard", "H9");
    const auto answer = accepted(stage_->trial(vibrated("test 1", 1)));
    EXPECT_FALSE(answer.vibration);
    for (const auto& each : rows()) EXPECT_FALSE(each.body.contains("vibration")) << each.name;
}

TEST_F(VibratedStageTest, TheBoardOnTheMotorSaysWhatItDidAndTheRowKeepsIt) {
    RecordProperty("hazard", "H9");
    beginVibrated({}, {"sim:massager", "sim:finger?on=motor"});
    rise(6);
    const auto made = vibrated("test 1", 6);
    const auto answer = accepted(stage_->trial(made));
    ASSERT_TRUE(answer.vibration);
    EXPECT_EQ(answer.vibration->moved, 3U);
    EXPECT_EQ(answer.vibration->missed, 0U);
    EXPECT_NEAR(answer.vibration->interval_s, 0.5, 0.02);
    EXPECT_GT(answer.vibration->strength_m_s2, 0.1);
    EXPECT_LT(answer.vibration->strength_m_s2, 15 * 0.3 * 0.3) << "no more than at full speed";
    EXPECT_GT(answer.vibration->latency_s, 0);
    const auto earlier = rows();
    beginVibrated(earlier);
    const auto again = accepted(stage_->trial(made));
    ASSERT_TRUE(again.replayed);
    ASSERT_TRUE(again.vibration);
    EXPECT_EQ(again.vibration->strength_m_s2, answer.vibration->strength_m_s2);
}

TEST_F(VibratedStageTest, NothingListensOnceAPresentationHasEndedHoweverItDid) {
    RecordProperty("hazard", "H2");
    beginVibrated({}, {"sim:massager", "sim:finger?on=motor"});
    ASSERT_FALSE(stage_->trial(vibrated("test 1", 2))) << "refused by the ramp rule";
    someone_.stops = 1;
    someone_.stoppedBy = "operator";
    ASSERT_FALSE(stage_->trial(vibrated("test 1", 1)));
    stage_.reset();  // crashes if a destroyed tap were still in use
    bench_->idle(Seconds(1));
    bench_.reset();
}

TEST_F(VibratedStageTest, AMotorThatDoesNotMoveIsSeenAndIsNoZero) {
    RecordProperty("hazard", "H9");
    beginVibrated({}, {"sim:massager?acceleration=0.1m/s2", "sim:finger?on=motor"});
    const auto answer = accepted(stage_->trial(vibrated("test 1", 1)));
    ASSERT_TRUE(answer.vibration);
    EXPECT_EQ(answer.vibration->moved, 0U);
    EXPECT_TRUE(std::isnan(answer.vibration->strength_m_s2));
}

}  // namespace
}  // namespace tacto::test
