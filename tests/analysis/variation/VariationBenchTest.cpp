#include <gtest/gtest.h>

#include "core/analysis/variation/VariationBench.h"

namespace tacto {
namespace {

TEST(VariationBench, WithoutTolerancesEveryBenchIsTheSame) {
    const BenchTolerances none{0, Volts(0), 0, 0, 0, 0, Micros(0)};
    const auto found = predictBench(EncodingProfile{}, Drive::Current, none, 100, 1).value();
    ASSERT_EQ(found.conditions.size(), 4U);
    EXPECT_EQ(found.conditions[2].amplitude_v.low, 40);
    EXPECT_EQ(found.conditions[2].amplitude_v.high, 40);
    EXPECT_EQ(found.conditions[1].interval_s.high, 0.5);
    EXPECT_NEAR(found.pairs[1].amplitude_jnd.value, std::log(4) / std::log(1.1), 1e-12);
    EXPECT_NEAR(found.pairs[0].interval_jnd.value, std::log(4) / std::log(1.16), 1e-12);
}

TEST(VariationBench, OneRectangularToleranceHasItsQuantiles) {
    BenchTolerances gain{0, Volts(0), 0, 0, 0, 0, Micros(0)};
    gain.stimulatorGain = 0.1;
    const auto found = predictBench(EncodingProfile{}, Drive::Voltage, gain, 20'000, 4).value();
    // 90 % of a uniform distribution over ± 4 V lie within ± 3.6 V; the tolerance is five standard deviations.
    const double within = 5 * 8 * std::sqrt(0.05 * 0.95 / 20'000);
    EXPECT_NEAR(found.conditions[2].amplitude_v.low, 40 - 3.6, within);
    EXPECT_NEAR(found.conditions[2].amplitude_v.high, 40 + 3.6, within);
    EXPECT_NEAR(found.conditions[2].amplitude_v.value, 40, 5 * 8 * 0.5 / std::sqrt(20'000.0));
    // An error of the gain affects both conditions of a pair, so their ratio is unchanged.
    EXPECT_NEAR(found.pairs[1].amplitude_jnd.low, found.pairs[1].amplitude_jnd.high, 1e-9);
}

TEST(VariationBench, TheLoadConcernsACurrentSourceAlone) {
    BenchTolerances load{0, Volts(0), 0.05, 0, 0, 0, Micros(0)};
    const auto current = predictBench(EncodingProfile{}, Drive::Current, load, 1000, 4).value();
    const auto voltage = predictBench(EncodingProfile{}, Drive::Voltage, load, 1000, 4).value();
    EXPECT_GT(current.conditions[0].amplitude_v.high - current.conditions[0].amplitude_v.low, 0.8);
    EXPECT_EQ(voltage.conditions[0].amplitude_v.high, voltage.conditions[0].amplitude_v.low);
}

TEST(VariationBench, SameSeedSameSpreadAndNothingSillyIsTaken) {
    const auto low = [](std::uint64_t seed) {
        return predictBench(EncodingProfile{}, Drive::Current, {}, 500, seed).value().conditions[0].amplitude_v.low;
    };
    EXPECT_EQ(low(1), low(1));
    EXPECT_NE(low(1), low(2));
    BenchTolerances wrong;
    wrong.scopeGain = std::nan("");
    EXPECT_FALSE(predictBench(EncodingProfile{}, Drive::Current, wrong, 500, 1));
    EXPECT_FALSE(predictBench(EncodingProfile{}, Drive::Current, {}, 99, 1));
}

TEST(VariationBench, QuantilesOfKnownValues) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    values.push_back(std::nan(""));
    const auto found = spreadOf(values);
    EXPECT_EQ(found.value, 50);
    EXPECT_NEAR(found.low, 5, 1e-12);
    EXPECT_NEAR(found.high, 95, 1e-12);
    EXPECT_TRUE(std::isnan(spreadOf({}).value));
}

}  // namespace
}  // namespace tacto
