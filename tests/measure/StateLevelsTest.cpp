#include <gtest/gtest.h>
#include <numbers>

#include "core/measure/StateLevels.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

StateLevels statesOf(const Capture& capture) {
    const auto& channel = capture.channels.front();
    return findStateLevels(channel.samples, channel.lsb, false);
}

template <class Function>
std::vector<float> sampled(std::size_t n, Function f) {
    std::vector<float> samples(n);
    for (std::size_t i = 0; i < n; ++i) samples[i] = static_cast<float>(f(static_cast<double>(i)));
    return samples;
}

TEST(StateLevels, FindsAPulseThatFillsAHundredThousandthOfTheRecord) {
    const auto levels = statesOf(recordOf({{1.0, 20e-6, 10, 1e-6}}, {.samples = 4'000'000, .noise = 0.05}));
    ASSERT_EQ(levels.count, StateCount::Two) << levels.why;
    EXPECT_NEAR(levels.baseline, 0, 0.01);
    EXPECT_NEAR(levels.high, 10, 0.1);
}

TEST(StateLevels, FindsTheBaselineBetweenPhasesThatOutweighIt) {
    // 400 us of phases in a record of 600 us.
    const auto levels = statesOf(recordOf(biphasic(50e-6), {.samples = 1200, .noise = 0.1}));
    ASSERT_EQ(levels.count, StateCount::Three) << levels.why;
    EXPECT_NEAR(levels.baseline, 0, 0.1);
}

TEST(StateLevels, TellsUndershootFromASecondPhase) {
    std::vector<SyntheticPhase> phases{{1e-3, 1e-3, 40, 2e-6}, {2e-3, 40e-6, -6, 2e-6}};
    const auto levels = statesOf(recordOf(phases, {.noise = 0.1}));
    ASSERT_EQ(levels.count, StateCount::Two) << levels.why;
    EXPECT_NEAR(levels.high, 40, 0.1);
    EXPECT_NEAR(levels.low, 0, 0.1);
}

TEST(StateLevels, ASquareWaveAboutZeroHasTwoStates) {
    const auto levels =
        findStateLevels(sampled(10'000, [](double i) { return std::fmod(i, 100) < 50 ? 1 : -1; }), 0, false);
    ASSERT_EQ(levels.count, StateCount::Two) << levels.why;
    EXPECT_DOUBLE_EQ(levels.high, 1);
    EXPECT_DOUBLE_EQ(levels.low, -1);
    EXPECT_DOUBLE_EQ(levels.baseline, -1);
}

TEST(StateLevels, ABaselineIsWhereTheSignalRestsOrElseZero) {
    const auto duty = [](double low, double high, double share) {
        return findStateLevels(
                   sampled(10'000, [=](double i) { return std::fmod(i, 1000) < 1000 * share ? high : low; }), 0, false)
            .baseline;
    };
    EXPECT_DOUBLE_EQ(duty(0, 5, 0.04), 0);
    EXPECT_DOUBLE_EQ(duty(0, 5, 0.95), 5) << "short gaps in a high level are the pulses";
    EXPECT_DOUBLE_EQ(duty(0, 5, 0.7), 0);
    EXPECT_DOUBLE_EQ(duty(-5, 0, 0.5), 0) << "pulses that go down from zero";
    EXPECT_DOUBLE_EQ(duty(1, 5, 0.7), 1);
}

TEST(StateLevels, WhatRestsNowhereHasNoStates) {
    RecordProperty("hazard", "H9");
    Random random(7, "noise");
    const double turn = 2 * std::numbers::pi;
    const std::vector<std::pair<const char*, std::vector<float>>> signals{
        {"constant", sampled(10'000, [](double) { return 3.0; })},
        {"white noise", sampled(20'000, [&](double) { return random.normal(); })},
        {"little noise", sampled(300, [&](double) { return random.normal(); })},
        {"sine", sampled(20'000, [=](double i) { return std::sin(turn * i / 500); })},
        {"slow sine with noise",
         sampled(20'000, [&](double i) { return std::sin(turn * i / 20'000) + 0.01 * random.normal(); })},
        {"ramp", sampled(20'000, [](double i) { return i; })},
        {"triangle", sampled(20'000, [](double i) { return std::abs(std::fmod(i, 400) - 200); })},
        {"too short", sampled(5, [](double i) { return i < 3 ? 0 : 1; })},
        {"nothing but missing samples", sampled(100, [](double) { return std::nan(""); })},
        {"empty", {}}};
    for (const auto& [name, samples] : signals) {
        const auto levels = findStateLevels(samples, 0, false);
        EXPECT_EQ(levels.count, StateCount::None) << name << ": " << levels.low << " " << levels.high;
        EXPECT_FALSE(levels.why.empty()) << name;
    }
}

TEST(StateLevels, ASmoothedNoiseHasNoStates) {
    Random random(11, "coloured");
    double state = 0;
    const auto samples = sampled(20'000, [&](double) { return state = 0.98 * state + random.normal(); });
    EXPECT_EQ(findStateLevels(samples, 0, false).count, StateCount::None);
}

TEST(StateLevels, FlickerOfOneStepIsNoPulse) {
    Random random(3, "flicker");
    const auto samples = sampled(5000, [&](double) { return 0.39 * std::floor(random.uniform() + 0.1); });
    EXPECT_EQ(findStateLevels(samples, 0.39, false).count, StateCount::None);
}

TEST(StateLevels, LogicIsZeroAndOneWhateverItsDuty) {
    const auto samples = sampled(1000, [](double i) { return std::fmod(i, 100) < 97 ? 1 : 0; });
    const auto levels = findStateLevels(samples, 0, true);
    ASSERT_EQ(levels.count, StateCount::Two);
    EXPECT_EQ(levels.baseline, 0);
    EXPECT_EQ(levels.high, 1);
    EXPECT_EQ(findStateLevels(sampled(1000, [](double) { return 1.0; }), 0, true).count, StateCount::None);
}

TEST(StateLevels, AGlitchOfTwoSamplesDoesNotHideTheStates) {
    auto capture = recordOf(biphasic(3e-3, 10), {.noise = 0.1});
    capture.channels[0].samples[100] = 500;
    capture.channels[0].samples[101] = -500;
    const auto levels = statesOf(capture);
    ASSERT_EQ(levels.count, StateCount::Three) << levels.why;
    EXPECT_NEAR(levels.high, 10, 0.1);
}

TEST(StateLevels, FindsABiphasicPulseThatFillsFourPercentOfTheRecord) {
    const auto levels = statesOf(recordOf(biphasic(3e-3), {.noise = 0.2}));
    ASSERT_EQ(levels.count, StateCount::Three) << levels.why;
    EXPECT_NEAR(levels.baseline, 0, 0.01);
    EXPECT_NEAR(levels.high, 40, 0.1);
    EXPECT_NEAR(levels.low, -40, 0.1);
    EXPECT_NEAR(levels.noise, 0.2, 0.02);
}

TEST(StateLevels, TakesASlowShallowRechargeForAThirdState) {
    const auto levels =
        statesOf(recordOf({{1e-3, 200e-6, 40, 2e-6}, {1.3e-3, 2e-3, -4, 2e-6}}, {.noise = 0.1, .lsb = 0.39}));
    ASSERT_EQ(levels.count, StateCount::Three) << levels.why;
    EXPECT_NEAR(levels.low, -4, 0.25);
    EXPECT_NEAR(levels.baseline, 0, 0.05);
}

}  // namespace
}  // namespace tacto::test
