#include <cmath>
#include <gtest/gtest.h>

#include "drivers/sigrok/protocol/RawRecord.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sigrok_driver;

RecordPlan planFor(double rate, std::size_t samples) {
    RecordPlan plan;
    plan.settings.sampleRate = Hertz(rate);
    plan.settings.samples = samples;
    plan.settings.preTrigger = 0.25;
    plan.voltageScale = Fraction{1, 1};
    return plan;
}

TEST(RawRecord, FindsTheCrossingNearestToWhereItIsExpected) {
    const std::vector<float> twice{0, 0, 4, 0, 0, 0, 0, 4, 4, 0};
    EXPECT_DOUBLE_EQ(crossing(twice, 2, 0).value(), 1.5);
    EXPECT_DOUBLE_EQ(crossing(twice, 2, 9).value(), 6.5);
    EXPECT_DOUBLE_EQ(crossing(twice, 1, 9).value(), 6.25);
    EXPECT_FALSE(crossing(twice, 5, 0).has_value());
    EXPECT_FALSE(crossing(twice, -2, 0).has_value()) << "it never falls below -2";
    EXPECT_DOUBLE_EQ(crossing({0, -4, 0}, -2, 0).value(), 0.5);
    EXPECT_FALSE(crossing({}, 1, 0).has_value());
}

TEST(RawRecord, SeesTheConvertersStepsButNotAFewValuesOrRounding) {
    std::vector<float> codes;
    for (int i = 0; i < 500; ++i) codes.push_back(0.04F * static_cast<float>((i * 37) % 101 - 50));
    EXPECT_NEAR(stepOf(codes), 0.04, 1e-6);
    EXPECT_EQ(stepOf({-10, 10, 10, -10}), 0) << "a square wave says nothing about the converter";
    std::vector<float> smooth;
    for (int i = 0; i < 500; ++i) smooth.push_back(std::sin(0.01F * static_cast<float>(i)));
    EXPECT_EQ(stepOf(smooth), 0);
    EXPECT_EQ(stepOf({}), 0);
}

TEST(RawRecord, CutsAroundTheTriggerAveragesAndConvertsTheShunt) {
    RawRecord raw;
    raw.rate_hz = 1000;
    raw.end_s = 10;  // 400 samples that begin at 9.6 s
    for (int i = 0; i < 400; ++i) {
        raw.voltage.push_back(i < 200 ? 0.0F : 8.0F);
        raw.current.push_back(i < 200 ? 0.0F : 0.5F);
    }
    Wiring wiring;
    wiring.current = 1;
    wiring.shunt = Ohms(100);
    auto plan = planFor(250, 40);  // 4 raw samples per sample, 160 in all, 40 before the trigger
    plan.currentScale = Fraction{1, 10};
    const auto capture = accepted(cut(raw, plan, wiring, 199.5));
    EXPECT_EQ(capture.rate_hz, 250);
    ASSERT_EQ(capture.channels.size(), 2U);
    EXPECT_EQ(capture.channels[0].samples.size(), 40U);
    EXPECT_EQ(capture.channels[0].samples[9], 0.0F);
    EXPECT_EQ(capture.channels[0].samples[10], 8.0F);
    EXPECT_NEAR(static_cast<double>(capture.channels[1].samples[10]), 0.005, 1e-9);
    EXPECT_EQ(capture.channels[1].unit, "A");
    EXPECT_NEAR(capture.channels[1].high, 0.005, 1e-12) << "5 divisions of 0.1 V over 100 ohm";
    EXPECT_NEAR(capture.trigger_s, 9.7995, 1e-9);
    EXPECT_NEAR(capture.start_s, 9.76 + 0.0015, 1e-9) << "a mean of four samples stands in their middle";
}

TEST(RawRecord, StaysInsideTheRecordAndRefusesWhatDoesNotFit) {
    RawRecord raw;
    raw.rate_hz = 1000;
    raw.voltage.assign(100, 1.0F);
    const auto early = accepted(cut(raw, planFor(1000, 100), {}, 3));
    EXPECT_EQ(early.samples(), 100U);
    EXPECT_EQ(cut(raw, planFor(1000, 101), {}, 3).error().code, ErrorCode::Device);
    EXPECT_EQ(cut(raw, planFor(300, 10), {}, 3).error().code, ErrorCode::Device) << "no multiple";
    EXPECT_EQ(cut(raw, planFor(2000, 10), {}, 3).error().code, ErrorCode::Device) << "faster than it sampled";
    Wiring both;
    both.current = 1;
    both.shunt = Ohms(1);
    raw.current.assign(99, 1.0F);
    EXPECT_EQ(cut(raw, planFor(1000, 10), both, 3).error().code, ErrorCode::Device) << "unequal channels";
}

}  // namespace
}  // namespace tacto::test
