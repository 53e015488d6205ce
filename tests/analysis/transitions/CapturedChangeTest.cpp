#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/transitions/CapturedChange.h"

namespace tacto {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const ChangeLimits kLimits{.perTrain_jnd = 2, .complete_s = 2, .secondsAlone = false};

CapturedTrain trainOf(double amplitude_jnd) {
    return {.amplitude_v = 20,
            .interval_s = 0.5,
            .onsetUncertainty_s = 1e-6,
            .amplitudeUncertainty_v = 1e-3,
            .amplitude_jnd = amplitude_jnd,
            .interval_jnd = 0};
}

CapturedChange changeOf(double amplitude_jnd, double complete_s) {
    return {.name = "up",
            .trains = {trainOf(amplitude_jnd), trainOf(0)},
            .measured = {.trains = 2, .complete_s = complete_s},
            .fastest = {.trains = 2, .complete_s = 1},
            .from_v = 10,
            .to_v = 20,
            .from_s = 0.5,
            .to_s = 0.5,
            .before_v = {10, 10.01}};
}

TEST(CapturedChange, PassesForSmallStepsThatAreCompleteInTime) {
    const auto judged = judgeChanges(std::vector{changeOf(1.5, 1.2)}, {"up"}, kLimits);
    EXPECT_EQ(judged.verdict, Verdict::Pass);
    EXPECT_THAT(judged.reasons, IsEmpty());
}

TEST(CapturedChange, FailsForAStepThatIsTooLargeAndForOneThatIsLate) {
    const auto large = judgeChanges(std::vector{changeOf(4, 1.2)}, {}, kLimits);
    EXPECT_EQ(large.verdict, Verdict::Fail);
    EXPECT_THAT(large.reasons, Contains(HasSubstr("4.00 just-noticeable differences; at most 2 are wanted")));
    const auto late = judgeChanges(std::vector{changeOf(1, 2.5)}, {}, kLimits);
    EXPECT_EQ(late.verdict, Verdict::Fail);
    EXPECT_EQ(late.groups.at(0).late, 1U);
}

TEST(CapturedChange, NotesWhatCannotBeCompleteInTimeAndPassesIt) {
    auto change = changeOf(1.5, 2.5);
    change.fastest.complete_s = 2.4;
    const auto judged = judgeChanges(std::vector{change}, {}, kLimits);
    EXPECT_EQ(judged.verdict, Verdict::Pass);
    EXPECT_THAT(judged.notes, Contains(HasSubstr("2 s are out of reach")));
    auto alone = kLimits;
    alone.secondsAlone = true;
    EXPECT_EQ(judgeChanges(std::vector{change}, {}, alone).verdict, Verdict::Fail);
}

TEST(CapturedChange, AMovementHasNoEndToWaitFor) {
    auto movement = changeOf(kNaN, kNaN);
    movement.kind = ChangeKind::Movement;
    movement.trains.push_back(trainOf(1));
    movement.trains.push_back(trainOf(1));
    movement.trains.erase(movement.trains.begin() + 1);
    movement.trains.at(0).interval_jnd = kNaN;
    const auto judged = judgeChanges(std::vector{movement}, {}, kLimits);
    EXPECT_FALSE(judged.groups.at(0).completes);
    EXPECT_EQ(judged.verdict, Verdict::Pass);
}

TEST(CapturedChange, IsIndeterminateForWhatWasNotMeasured) {
    EXPECT_EQ(judgeChanges({}, {}, kLimits).verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeChanges({}, {"up"}, kLimits).verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeChanges(std::vector{changeOf(kNaN, 1)}, {}, kLimits).verdict, Verdict::Indeterminate);
    auto alone = changeOf(1, 1);
    alone.before_v.clear();  // without trains of one command, the scatter is unknown
    EXPECT_EQ(judgeChanges(std::vector{alone}, {}, kLimits).verdict, Verdict::Indeterminate);
}

TEST(CapturedChange, AnUncertaintyThatIsUnknownOnceIsNotMadeUpForByTheNextTrain) {
    for (const std::size_t which : {0U, 1U}) {
        auto change = changeOf(1.5, 1.2);
        change.trains.at(which).onsetUncertainty_s = kNaN;
        const auto judged = judgeChanges(std::vector{change}, {}, kLimits);
        EXPECT_EQ(judged.verdict, Verdict::Indeterminate) << which;
        EXPECT_THAT(judged.reasons, Contains(HasSubstr("its uncertainty is unknown"))) << which;
    }
}

TEST(CapturedChange, AnIntervalOfAMovementHangsOnThreeStamps) {
    auto scatter = changeOf(1.5, 1.2);
    for (const std::size_t which : {0U, 1U, 2U}) {
        auto movement = changeOf(1, kNaN);
        movement.name = "finger";
        movement.kind = ChangeKind::Movement;
        movement.trains = {trainOf(1), trainOf(1), trainOf(1)};
        movement.trains.at(which).onsetUncertainty_s = kNaN;
        const auto judged = judgeChanges(std::vector{movement, scatter}, {}, kLimits);
        EXPECT_EQ(judged.groups.at(0).verdict, Verdict::Indeterminate) << which;
        EXPECT_TRUE(std::isnan(judged.groups.at(0).interval.uncertainty)) << which;
    }
}

TEST(CapturedChange, WhereNoIntervalWasMeasuredItsUncertaintyIsUnknownNotZero) {
    auto change = changeOf(1.5, 1.2);
    for (auto& train : change.trains) train.interval_s = train.interval_jnd = kNaN;
    const auto judged = judgeChanges(std::vector{change}, {}, kLimits);
    EXPECT_EQ(judged.verdict, Verdict::Indeterminate);
    EXPECT_TRUE(std::isnan(judged.groups.at(0).interval.uncertainty));
}

using ::testing::ElementsAre;

CapturedChange stepOf(const char* name, double latency_s, double trains) {
    return {.name = name,
            .measured = {.latency_s = latency_s, .trains = trains},
            .designed = {.latency_s = 0.2, .trains = 3}};
}

TEST(StepLatency, PassesWithinTheToleranceOfTheDesign) {
    const std::vector steps{stepOf("up", 0.21, 3), stepOf("up", 0.19, 2)};
    const auto judged = judgeLatency(steps, {"up"}, 0.02);
    EXPECT_EQ(judged.verdict, Verdict::Pass);
    EXPECT_TRUE(judged.reasons.empty());
    EXPECT_EQ(judged.groups.at(0).latency_s.n, 2U);
}

TEST(StepLatency, FailsForATrainOffTheDesignAndForTooManyTrains) {
    const std::vector late{stepOf("up", 0.25, 3)}, slow{stepOf("up", 0.2, 4)};
    EXPECT_EQ(judgeLatency(late, {}, 0.02).verdict, Verdict::Fail);
    EXPECT_THAT(judgeLatency(late, {}, 0.02).reasons, ElementsAre(HasSubstr("0.0500 s off the design")));
    EXPECT_EQ(judgeLatency(slow, {}, 0.02).verdict, Verdict::Fail);
}

TEST(StepLatency, WithinWhatAMeasurementOfTheDesignMayFindThereIsNoDifference) {
    auto step = stepOf("up", 0.25, 3);
    step.designedFirst.latency_s = 0.15;
    step.designedLast.latency_s = 0.3;
    EXPECT_EQ(judgeLatency(std::vector{step}, {}, 0.02).verdict, Verdict::Pass);
}

TEST(StepLatency, IsIndeterminateForWhatIsMissing) {
    EXPECT_EQ(judgeLatency({}, {}, 0.02).verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeLatency(std::vector{stepOf("up", 0.2, 3)}, {"up", "down"}, 0.02).verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeLatency(std::vector{stepOf("up", kNaN, 3)}, {}, 0.02).verdict, Verdict::Indeterminate);
    EXPECT_EQ(judgeLatency(std::vector{stepOf("up", 0.2, kNaN)}, {}, 0.02).verdict, Verdict::Indeterminate);
}

}  // namespace
}  // namespace tacto
