// One slip does not cost a session: a doubtful "too strong" is asked about once, an unusable range is measured again
// where the operator wants it, and a slow computer is called a slow computer.
#include "core/pilot/PilotThresholds.h"
#include "tests/pilot/StageFixture.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class PilotSlipTest : public PilotStageTest {
protected:
    /// Feels from `felt` and calls `strong` too strong; at `slipsAt`, once in the second series, says too strong too.
    void feels(double felt, double strong, double slipsAt = 0) {
        someone_.onAsk = [this, felt, strong, slipsAt](const PilotPrompt& prompt) {
            if (prompt.name == "hold") starts_.push_back(prompt.text);
            if (prompt.name == "meant") EXPECT_EQ(state(), InterlockState::Disarmed) << "the output is off meanwhile";
            if (prompt.name != "strength") return;
            const bool slip = !slipped_ && starts_.size() == 2 && someone_.level == slipsAt;
            slipped_ = slipped_ || slip;
            someone_.answers["strength"] = slip || someone_.level >= strong ? "too-strong"
                                           : someone_.level >= felt         ? "weak"
                                                                            : "nothing";
        };
        someone_.letsGo = true;
    }
    /// Returns how often the gate was told that a level is too strong, and the lowest of them.
    [[nodiscard]] std::size_t reported() const { return bodies("level-too-strong").size(); }
    std::vector<std::string> starts_;
    bool slipped_ = false;
};

TEST_F(PilotSlipTest, TooStrongFarBelowWhatWasToleratedAsksOnceMoreAndASlipGoesOn) {
    RecordProperty("hazard", "H12");
    RecordProperty("hazard", "H6");
    feels(2, 5, 1);
    someone_.answers["meant"] = "no";
    PilotThresholds thresholds(*stage_);
    accepted(thresholds.ascendingLimits());
    EXPECT_TRUE(slipped_);
    EXPECT_EQ(thresholds.limits().tooStrong, 5);
    EXPECT_EQ(thresholds.limits().series[1].highest, 4.5);
    EXPECT_EQ(std::ranges::count(someone_.asked, "meant"), 1);
    EXPECT_EQ(reported(), 1U) << "the gate is told of the level that was meant alone";
    EXPECT_EQ(bodies(row::kHold).size(), 2U) << "the operator answers for either";
    ASSERT_GE(starts_.size(), 3U);
    EXPECT_THAT(starts_[0], HasSubstr("1 of 3"));
    EXPECT_THAT(starts_[0], HasSubstr("zero"));

    const auto before = thresholds.toJson();
    const auto earlier = rows();
    someone_.asked.clear();
    begin(earlier);
    PilotThresholds again(*stage_);
    accepted(again.ascendingLimits());
    EXPECT_EQ(again.toJson(), before);
    EXPECT_TRUE(someone_.asked.empty()) << "nothing is asked twice";
}

TEST_F(PilotSlipTest, WhoMeantItKeepsTheirCeiling) {
    RecordProperty("hazard", "H2");
    feels(2, 5, 1);
    PilotThresholds thresholds(*stage_);
    accepted(thresholds.ascendingLimits());
    EXPECT_EQ(thresholds.limits().tooStrong, 1);
    EXPECT_EQ(thresholds.limits().series[2].highest, 0.5);
    EXPECT_EQ(reported(), 2U);
}

TEST_F(PilotSlipTest, ASlipInTheRampEndsNoSession) {
    RecordProperty("hazard", "H12");
    someone_.letsGo = true;
    LevelRamp ramp(*stage_, true);
    for (const double level : {0.5, 1.0, 1.5})
        ASSERT_TRUE(ramp.judged(level, false, fmt::format("ascending {}", level), true));
    int slips = 1;
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.name == "strength") someone_.answers["strength"] = slips-- > 0 ? "too-strong" : "weak";
    };
    someone_.answers["meant"] = "no";
    accepted(ramp.reach());
    EXPECT_EQ(endedBy(*record_), "");
    EXPECT_THAT(answered(), Contains("ramp 0 0.5 again"));
    EXPECT_EQ(bodies(row::kHold).size(), 1U) << "the operator answers by name before it comes again";
    slips = 2;
    ramp.becomeDue();
    EXPECT_THAT(ramp.reach(), refused(ErrorCode::Stopped)) << "said twice, it is meant";
    EXPECT_THAT(endedBy(*record_), HasSubstr("too strong now"));
}

TEST_F(PilotSlipTest, ARangeThatIsNotUsableIsMeasuredAgainWhereTheOperatorWantsIt) {
    RecordProperty("hazard", "H12");
    feels(100, 200);  // the electrodes have no contact: nothing is felt
    someone_.answers["measure-again"] = "yes";
    stage_->settings().cap = 6;
    int measured = 0;
    stage_->onSeatedAgain([&]() -> Result<void> {
        ++measured;
        return {};
    });
    PilotThresholds thresholds(*stage_);
    const auto measure = [](PilotThresholds& all) -> Result<void> {
        if (auto done = all.ascendingLimits(); !done) return done;
        if (auto done = all.detection(DetectionMethod::Staircase); !done) return done;
        return all.range();
    };
    accepted(measure(thresholds));
    ASSERT_FALSE(thresholds.found()->usable);
    EXPECT_TRUE(accepted(thresholds.measureAgain()));
    feels(1, 200);
    someone_.answers["interval"] = "first";
    accepted(measure(thresholds));
    EXPECT_EQ(thresholds.limits().felt, 1);
    EXPECT_EQ(measured, 1) << "the electrodes were seated again";
    const auto names = answered();
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size()) << "each presentation has its own name";
    EXPECT_NE(record_->find(row::kRange, "range 2"), nullptr);

    const auto found = thresholds.toJson();
    const auto earlier = rows();
    begin(earlier);
    stage_->settings().cap = 6;
    someone_.asked.clear();
    PilotThresholds again(*stage_);
    accepted(measure(again));
    EXPECT_TRUE(accepted(again.measureAgain()));
    accepted(measure(again));
    EXPECT_EQ(again.toJson(), found);
    EXPECT_TRUE(someone_.asked.empty()) << "a resumed session asks nothing twice";
}

TEST_F(PilotSlipTest, WhatWasTooStrongIsNotPresentedAgainWhenMeasuredAgain) {
    RecordProperty("hazard", "H6");
    feels(100, 4);  // nothing is felt until it is too strong
    someone_.answers["measure-again"] = "yes";
    PilotThresholds thresholds(*stage_);
    const auto measure = [&]() -> Result<void> {
        if (auto done = thresholds.ascendingLimits(); !done) return done;
        if (auto done = thresholds.detection(DetectionMethod::Staircase); !done) return done;
        return thresholds.range();
    };
    accepted(measure());
    ASSERT_EQ(thresholds.limits().tooStrong, 4);
    ASSERT_TRUE(accepted(thresholds.measureAgain()));
    std::vector<double> levels;
    feels(1, 200);
    someone_.onAsk = [this, &levels, asked = someone_.onAsk](const PilotPrompt& prompt) {
        asked(prompt);
        if (prompt.name == "strength") levels.push_back(someone_.level);
    };
    accepted(thresholds.ascendingLimits());
    ASSERT_FALSE(levels.empty());
    EXPECT_LE(levels.front(), 0.5) << "from zero, and by no ramp to what was accepted before";
    EXPECT_EQ(std::ranges::max(levels), 3.5) << "one step below what was too strong";
}

TEST_F(PilotSlipTest, ARampReachesNothingOfBeforeTheElectrodesWereSeatedAnew) {
    RecordProperty("hazard", "H6");
    someone_.letsGo = true;
    LevelRamp ramp(*stage_, true);
    for (const double level : {0.5, 1.0, 1.5})
        ASSERT_TRUE(ramp.judged(level, false, fmt::format("ascending {}", level), true));
    ramp.forgetAccepted();
    ramp.becomeDue();
    accepted(ramp.reach());
    EXPECT_TRUE(answered().empty());
}

TEST_F(PilotSlipTest, AnUnusableRangeIsRepeatedTwiceAtMost) {
    RecordProperty("hazard", "H12");
    feels(100, 200);
    someone_.answers["measure-again"] = "yes";
    stage_->settings().cap = 2;
    PilotThresholds thresholds(*stage_);
    for (int round = 0; round <= PilotThresholds::kMaxRepeats; ++round) {
        accepted(thresholds.ascendingLimits());
        accepted(thresholds.detection(DetectionMethod::Quest));
        accepted(thresholds.range());
        EXPECT_EQ(accepted(thresholds.measureAgain()), round < PilotThresholds::kMaxRepeats);
    }
}

TEST_F(PilotSlipTest, ASlowComputerIsNoFaultOfTheElectrodes) {
    RecordProperty("hazard", "H12");
    std::vector<std::string> told;
    int stalls = 1;
    someone_.onShow = [&] {
        if (someone_.shown.back().state == ScreenState::Feel && stalls-- > 0)
            std::static_pointer_cast<VirtualClock>(clock_)->sleepFor(toInstant(Seconds(1)));  // counts as silence
    };
    someone_.onAsk = [&](const PilotPrompt& prompt) {
        if (prompt.kind == PromptKind::GoOn) told.push_back(prompt.text);
    };
    ASSERT_TRUE(stage_->trial(trial()));
    ASSERT_EQ(told.size(), 2U);
    EXPECT_THAT(told[0], HasSubstr("computer was too slow"));
    EXPECT_THAT(told[0], HasSubstr("nothing is wrong with the electrodes"));
    EXPECT_THAT(told[0], Not(HasSubstr("See to the electrodes")));
    EXPECT_THAT(told[1], HasSubstr("computer was too slow"));
    EXPECT_EQ(record_->count(row::kFault), 1U);
}

TEST_F(PilotSlipTest, TheSecondFaultSaysOnceWhatItWas) {
    RecordProperty("hazard", "H12");
    someone_.onShow = [&] {
        if (someone_.shown.back().state == ScreenState::Feel)
            std::static_pointer_cast<VirtualClock>(clock_)->sleepFor(toInstant(Seconds(1)));  // counts as silence
    };
    EXPECT_THAT(stage_->trial(trial()),
                test::refusedSaying("a second fault ends the session: the computer was too slow for 0.1 s"));
}

}  // namespace
}  // namespace tacto::test
