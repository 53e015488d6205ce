// How often the stated interval contains the truth: 93 to 97 % of 1000 runs, neither more nor less. The instrument's
// errors are drawn for each run from the distributions in the budget.
#include <array>
#include <gtest/gtest.h>

#include "tests/analysis/calibration/CalibrationTwin.h"

namespace tacto::test {
namespace {

constexpr int kRuns = 1000;
// Even with fewer draws than in a report, the interval varies far less than the result of 1000 runs.
constexpr std::size_t kDraws = 2000;

/// Number of runs in which the interval contained the truth.
struct Covered {
    std::array<int, 3> level{};  ///< lowest, middle and largest command
    std::array<int, 3> worst{};  ///< for the mean of the worse direction, which is judged
    int gain = 0;
    int offset = 0;
    int monteCarlo = 0;  ///< number of budgets at the largest command computed by Monte Carlo
};

Covered coverageOf(const CalibrationTwin& twin) {
    Covered covered;
    const std::array<std::size_t, 3> looked{0, twin.levels / 2, twin.levels - 1};
    for (int run = 0; run < kRuns; ++run) {
        const auto seed = static_cast<std::uint64_t>(run) + 1;
        const auto found = fitCalibration(twin.run(seed));
        if (!found) {
            ADD_FAILURE() << found.error().message;
            return covered;
        }
        const auto judged = judgeCalibration(*found, twin.instrument, 2, {seed, kDraws});
        if (!judged) {
            ADD_FAILURE() << judged.error().message;
            return covered;
        }
        for (std::size_t k = 0; k < looked.size(); ++k) {
            const auto& level = judged->levels[looked[k]];
            const double truth = twin.truth(level.commanded) - level.commanded;
            covered.level[k] += std::abs(level.error - truth) <= level.budget.expanded ? 1 : 0;
            const auto& read = found->levels[looked[k]];
            const bool up = std::abs(level.worstError - (read.meanUp - read.commanded)) < 1e-12;
            const double worstTruth = truth + (up ? -0.5 : 0.5) * twin.hysteresis;
            covered.worst[k] += std::abs(level.worstError - worstTruth) <= level.worstBudget.expanded ? 1 : 0;
        }
        covered.gain += std::abs(found->gain - twin.gain) <= judged->gain.expanded ? 1 : 0;
        covered.offset += std::abs(found->offset - twin.offset) <= judged->offset.expanded ? 1 : 0;
        covered.monteCarlo += judged->fullScale().budget.method == CoverageMethod::MonteCarlo ? 1 : 0;
    }
    return covered;
}

void expectStated(const Covered& covered) {
    const auto stated = [](int count, const char* what) {
        EXPECT_GE(count, 930) << what << ": too narrow";
        EXPECT_LE(count, 970) << what << ": too wide";
    };
    stated(covered.level[0], "lowest level");
    stated(covered.level[1], "middle level");
    stated(covered.level[2], "largest level");
    stated(covered.worst[0], "worse direction of the lowest level");
    stated(covered.worst[1], "worse direction of the middle level");
    stated(covered.worst[2], "worse direction of the largest level");
    stated(covered.gain, "gain");
    stated(covered.offset, "offset");
    testing::Test::RecordProperty("covered_largest", covered.level[2]);
    testing::Test::RecordProperty("covered_gain", covered.gain);
    testing::Test::RecordProperty("covered_offset", covered.offset);
}

TEST(CalibrationCoverage, HoldsWhereTheOscilloscopesGainDominates) {
    RecordProperty("hazard", "H9");
    CalibrationTwin twin;
    twin.instrument = {.gainTolerance = 0.005, .offsetTolerance = 0.05, .resolution = 0.025};
    const auto covered = coverageOf(twin);
    expectStated(covered);
    EXPECT_EQ(covered.monteCarlo, kRuns);  // one rectangle dominates: k = 1.96 would be too wide
}

TEST(CalibrationCoverage, HoldsWhereScatterDominates) {
    RecordProperty("hazard", "H9");
    CalibrationTwin twin;
    twin.jitter = 0.4;
    twin.instrument = {.gainTolerance = 0.001, .offsetTolerance = 0.01, .resolution = 0.01};
    const auto covered = coverageOf(twin);
    expectStated(covered);
    EXPECT_LT(covered.monteCarlo, kRuns / 20);
}

TEST(CalibrationCoverage, HoldsWhereScatterGrowsWithTheCommand) {
    CalibrationTwin twin;
    twin.jitter = 0.2;
    twin.jitterScales = true;
    twin.hysteresis = 0.3;
    twin.instrument = {.gainTolerance = 0.003, .offsetTolerance = 0.03, .resolution = 0.02};
    const auto covered = coverageOf(twin);
    // The standard errors of the line assume equal scatter at all levels, so only the levels must meet the limits.
    for (const int count : covered.level) {
        EXPECT_GE(count, 930);
        EXPECT_LE(count, 970);
    }
}

TEST(CalibrationCoverage, AnInstrumentWorseThanStatedIsNoticed) {
    // The test can fail: with twice the stated errors, the same count is out of its range.
    CalibrationTwin twin;
    twin.instrument = {.gainTolerance = 0.01, .offsetTolerance = 0.1, .resolution = 0.025};
    int covered = 0;
    for (int run = 0; run < kRuns; ++run) {
        const auto found = fitCalibration(twin.run(static_cast<std::uint64_t>(run) + 1));
        ASSERT_TRUE(found);
        Calibration top = *found;
        top.levels = {found->levels.front(), found->levels.back()};
        const InstrumentErrors stated{.gainTolerance = 0.005, .offsetTolerance = 0.05, .resolution = 0.025};
        const auto judged = judgeCalibration(top, stated, 2, {1, 2000});
        ASSERT_TRUE(judged);
        const double truth = twin.truth(twin.high) - twin.high;
        covered += std::abs(judged->levels[1].error - truth) <= judged->levels[1].budget.expanded ? 1 : 0;
    }
    EXPECT_LT(covered, 700);
}

}  // namespace
}  // namespace tacto::test
