#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/transitions/StepLatency.h"

namespace tacto {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
