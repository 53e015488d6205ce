// Gates of pilot.md section 3 about the electrodes and the STOPs: each refusal has its sentence, and nothing is
// presented after it.
#include <thread>

#include "core/pilot/PilotCare.h"
#include "tests/pilot/StageFixture.h"
#include "tests/support/WrappedTwin.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// A simulated stimulator that switches off slowly, or with electrodes that gradually come off.
class WornStimulator final : public WrappedStimulator {
public:
    WornStimulator(std::unique_ptr<Stimulator> twin, std::chrono::milliseconds offTakes, double skinLater)
        : WrappedStimulator(std::move(twin)), offTakes_(offTakes), skinLater_(skinLater) {}
    Result<StimulatorStatus> status() override {
        auto read = WrappedStimulator::status();
        if (read && read->impedance && read->at > std::chrono::seconds(20)) *read->impedance *= skinLater_;
        return read;
    }
    void forceOff() noexcept override {
        std::this_thread::sleep_for(offTakes_);
        WrappedStimulator::forceOff();
    }

private:
    const std::chrono::milliseconds offTakes_;
    const double skinLater_;
};

class PilotGateTest : public PilotStageTest {
protected:
    void SetUp() override {
        PilotStageTest::SetUp();
        someone_.answers = {{"erythema", "0"}, {"oedema", "0"}};
    }
    void wear(std::chrono::milliseconds offTakes, double skinLater) {
        wrap_ = [=](std::unique_ptr<Stimulator> twin) {
            return std::make_unique<WornStimulator>(std::move(twin), offTakes, skinLater);
        };
        begin();
    }
    void expectRefused(const Result<void>& gate, const char* says) {
        ASSERT_FALSE(gate);
        EXPECT_THAT(gate.error().message, HasSubstr(says));
        EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
        EXPECT_NE(state(), InterlockState::Armed);
    }
};

TEST_F(PilotGateTest, AStopThatTakesLongerThanTenMillisecondsEndsTheSession) {
    RecordProperty("hazard", "H2");
    wear(std::chrono::milliseconds(15), 1);
    PilotCare care(*stage_);
    expectRefused(care.checklist(), "to switch off; at most 10 ms are accepted");
    EXPECT_EQ(stage_->ended(), PilotEnd::Stopped);
}

TEST_F(PilotGateTest, ElectrodesOfWhichTwoChecksDisagreeAreSeatedAgain) {
    RecordProperty("hazard", "H3");
    for (const auto& [change, holds] : {std::pair{1.15, true}, {1.25, false}, {0.75, false}}) {
        SCOPED_TRACE(change);
        wear(std::chrono::milliseconds(0), change);
        PilotCare care(*stage_);
        const auto passed = care.checklist();
        EXPECT_TRUE(passed) << passed.error().message;
        EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished);
        EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
        std::vector<std::string> refusals;
        for (const auto& each : rows()) {
            if (each.name == row::kGate && !each.body.value("holds", true)) refusals.push_back(each.body["said"]);
        }
        ASSERT_EQ(refusals.size(), holds ? 0U : 1U);
        if (holds) continue;
        EXPECT_THAT(refusals[0], HasSubstr("within 30 s; a difference of at most 20 % is accepted"));
    }
}

TEST_F(PilotGateTest, ElectrodesOutsideTheProfilesRangeAreSeatedAgainAndTheThirdTimeItIsBrokenOff) {
    RecordProperty("hazard", "H3");
    more_ = "&load=200kohm";
    begin();
    PilotCare care(*stage_);
    const auto passed = care.checklist();
    ASSERT_FALSE(passed);
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
    EXPECT_NE(state(), InterlockState::Armed);
    EXPECT_EQ(stage_->ended(), PilotEnd::Unfinished) << "it can be gone on with";
    int refused = 0;
    for (const auto& each : rows())
        if (each.name == row::kGate && each.body.value("holds", true) == false) ++refused;
    EXPECT_EQ(refused, 2) << "and the third ends it: " << passed.error().message;
    EXPECT_THAT(passed.error().message, HasSubstr("ohm"));
}

TEST_F(PilotGateTest, TheLotOfTheElectrodesIsNoted) {
    PilotCare care(*stage_);
    someone_.answers["electrode-lot"] = "L-2044";
    ASSERT_TRUE(care.checklist());
    const auto* lot = record_->find(row::kGate, "electrode lot");
    ASSERT_NE(lot, nullptr);
    EXPECT_EQ((*lot)["key"], "L-2044");
}

TEST_F(PilotGateTest, AStudyOfAnotherTrainOrWithoutAnAreaBeginsNothing) {
    RecordProperty("hazard", "H11");
    profile_.electrodeArea.reset();
    begin();
    PilotCare care(*stage_);
    expectRefused(care.checklist(), "the area of the electrodes is not stated; one in cm² is expected");
    EXPECT_TRUE(someone_.asked.empty());
}

}  // namespace
}  // namespace tacto::test
