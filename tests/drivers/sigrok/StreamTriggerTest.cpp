#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "drivers/sigrok/protocol/StreamTrigger.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sigrok_driver;

RecordPlan triggeredPlan(std::size_t samples, double level) {
    RecordPlan plan;
    plan.settings.sampleRate = Hertz(1000);
    plan.settings.samples = samples;
    plan.settings.preTrigger = 0.25;
    plan.triggerLevel_V = level;
    return plan;
}

/// Makes a signal of zeros with pulses of `height` and 5 samples at `onsets`.
std::vector<float> pulses(std::size_t length, const std::vector<std::size_t>& onsets, float height = 10) {
    std::vector<float> signal(length, 0.0F);
    for (const auto onset : onsets) {
        for (std::size_t k = 0; k < 5; ++k) signal[onset + k] = height;
    }
    return signal;
}

TEST(StreamTrigger, OneRecordPerPulseHoweverThePacketsFall) {
    const auto seed = testing::UnitTest::GetInstance()->random_seed();
    std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
    for (int round = 0; round < 50; ++round) {
        const auto signal = pulses(200'000, {1000, 1020, 30'000, 150'000});  // the second lies in the first record
        StreamTrigger trigger(triggeredPlan(100, 5), {});
        std::vector<Capture> found;
        std::uniform_int_distribution<std::size_t> sizes(1, 40'000);
        for (std::size_t at = 0; at < signal.size();) {
            const auto size = std::min(sizes(random), signal.size() - at);
            trigger.add(0, std::span(signal).subspan(at, size), 0.01, static_cast<double>(at + size) / 1000);
            at += size;
            for (;;) {
                auto next = accepted(trigger.next());
                if (!next) break;
                found.push_back(std::move(*next));
            }
        }
        ASSERT_EQ(found.size(), 3U) << "seed " << seed << ", round " << round;
        const double onsets[] = {1000, 30'000, 150'000};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(found[i].trigger_s, (onsets[i] - 0.5) / 1000, 1e-6);
            EXPECT_EQ(found[i].samples(), 100U);
            EXPECT_EQ(found[i].channels[0].samples[25], 10.0F);
            EXPECT_EQ(found[i].channels[0].samples[24], 0.0F);
        }
    }
}

TEST(StreamTrigger, FallingPulsesTriggerOnTheWayDown) {
    StreamTrigger trigger(triggeredPlan(100, -5), {});
    const auto signal = pulses(1000, {500}, -10);
    trigger.add(0, signal, 0.01, 1);
    const auto found = trigger.next();
    ASSERT_TRUE(found.has_value() && found->has_value());
    EXPECT_NEAR((*found)->trigger_s, 0.4995, 1e-6);
}

TEST(StreamTrigger, AForcedRecordIsMarkedAndATriggerBeforeItWins) {
    StreamTrigger quiet(triggeredPlan(100, 5), {});
    quiet.add(0, pulses(1000, {}), 0.01, 1);
    ASSERT_FALSE(quiet.next()->has_value());
    quiet.force();
    quiet.add(0, pulses(1000, {}), 0.01, 2);
    const auto forced = quiet.next();
    ASSERT_TRUE(forced->has_value());
    EXPECT_TRUE((*forced)->untriggered);
    EXPECT_TRUE(std::isnan((*forced)->trigger_s));
    EXPECT_FALSE(quiet.next()->has_value()) << "one record for one call";
}

TEST(StreamTrigger, WaitsForBothChannels) {
    Wiring wiring;
    wiring.current = 3;
    wiring.shunt = Ohms(100);
    StreamTrigger trigger(triggeredPlan(100, 5), wiring);
    trigger.add(0, pulses(1000, {500}), 0.01, 1);
    trigger.add(2, pulses(1000, {100}), 0.01, 1);
    EXPECT_FALSE(trigger.next()->has_value());
    trigger.add(3, pulses(1000, {500}, 1), 0.01, 1);
    const auto found = trigger.next();
    ASSERT_TRUE(found.has_value() && found->has_value());
    EXPECT_NEAR(static_cast<double>((*found)->channels[1].samples[25]), 0.01, 1e-9);
}

}  // namespace
}  // namespace tacto::test
