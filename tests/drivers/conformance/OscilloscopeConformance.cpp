#include "tests/drivers/conformance/OscilloscopeConformance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/Random.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {

void OscilloscopeConformance::SetUp() {
    rig_ = GetParam().make();
    ASSERT_NE(rig_, nullptr);
}

ScopeSettings OscilloscopeConformance::usual() const {
    ScopeSettings settings;
    settings.sampleRate = std::min(Hertz(1e6), rig_->device().traits().maxRate);
    settings.samples = std::min<std::size_t>(2000, rig_->device().traits().memoryDepth);
    settings.triggerLevel = 5;
    return settings;
}

std::optional<Capture> OscilloscopeConformance::captured() {
    for (int i = 0; i < 20; ++i) {
        auto found = device().poll();
        EXPECT_IN_TIME(found);
        if (!found) return std::nullopt;
        if (*found) return std::move(**found);
        rig_->wait(Seconds(0.01));
    }
    return std::nullopt;
}

TEST_P(OscilloscopeConformance, DeclaresWhatItCanDo) {
    EXPECT_EQ(device().identity().role, Role::Oscilloscope);
    EXPECT_GT(device().traits().maxRate.value(), 0);
    EXPECT_GT(device().traits().memoryDepth, 0U);
    EXPECT_GE(device().traits().bits, 1);
}

TEST_P(OscilloscopeConformance, RefusesSettingsItCannotKeep) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [&](const char* what, auto change) {
        ScopeSettings settings = usual();
        change(settings);
        const auto configured = device().configure(settings);
        ASSERT_FALSE(configured.has_value()) << what;
        EXPECT_EQ(configured.error().code, ErrorCode::InvalidArgument) << what;
    };
    refused("rate 0", [](auto& s) { s.sampleRate = Hertz(0); });
    refused("rate NaN", [&](auto& s) { s.sampleRate = Hertz(nan); });
    refused("rate above its own", [&](auto& s) { s.sampleRate = device().traits().maxRate * 2; });
    refused("no samples", [](auto& s) { s.samples = 0; });
    refused("more than its memory", [&](auto& s) { s.samples = device().traits().memoryDepth + 1; });
    refused("pre-trigger above 1", [](auto& s) { s.preTrigger = 1.5; });
    refused("pre-trigger NaN", [&](auto& s) { s.preTrigger = nan; });
    refused("trigger level NaN", [&](auto& s) { s.triggerLevel = nan; });
    refused("no voltage range", [](auto& s) { s.voltageRange = Volts(0); });
    refused("no current range", [](auto& s) { s.currentRange = Milliamps(-1); });
    EXPECT_IN_TIME(device().configure(usual()));
}

/// A value inside a range, or outside it: beside either end, far away, or no number.
double drawn(Random& random, double low, double high, bool good) {
    if (good) return std::clamp(low * std::pow(high / low, random.uniform()), low, high);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    const double wrong[] = {0, -low, -high, nan, infinite, -infinite, std::nextafter(high, infinite) * (1 + 1e-12)};
    return wrong[random.below(std::size(wrong))];
}

TEST_P(OscilloscopeConformance, RefusesTheSameSettingsAsEveryOther) {
    RecordProperty("hazard", "H12");
    Random random(53, "oscilloscope settings");
    const auto& traits = device().traits();
    for (int trial = 0; trial < 300; ++trial) {
        auto s = usual();
        const auto wrong = random.below(7);
        const auto draw = [&](std::uint64_t which, double low, double high) {
            return drawn(random, low, high, which != wrong);
        };
        if (wrong == 0 || trial % 2 == 0) s.sampleRate = Hertz(draw(0, 100, traits.maxRate.value()));
        s.voltageRange = Volts(draw(1, 1e-3, 10'000));
        s.currentRange = Milliamps(draw(2, 1e-3, 1e6));
        s.triggerOnCurrent = random.below(2) == 0;
        const double range = s.triggerOnCurrent ? s.currentRange.value() * 1e-3 : s.voltageRange.value();
        if (range > 0 && range < 1e9) s.triggerLevel = draw(3, 1e-3 * range, range);
        s.preTrigger = wrong == 4 ? std::array{-1e-9, 1.0000001, 2.0, double(NAN)}[random.below(4)] : random.uniform();
        if (wrong == 5) s.samples = random.below(2) == 0 ? random.below(2) : traits.memoryDepth + 1 + random.below(9);
        const auto done = device().configure(s);
        if (wrong < 6) {
            ASSERT_FALSE(done) << trial << " wrong: " << wrong;
            EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument) << done.error().message;
            const char* named[] = {"sample rate",   "voltage range", "current range",
                                   "trigger level", "pre-trigger",   "record of"};
            EXPECT_NE(done.error().message.find(named[wrong]), std::string::npos) << done.error().message;
        } else if (device().identity().simulated) {
            EXPECT_TRUE(done) << done.error().message;
        }
    }
}

TEST_P(OscilloscopeConformance, HasNothingBeforeATrigger) {
    ASSERT_IN_TIME(device().configure(usual()));
    ASSERT_IN_TIME(device().arm());
    rig_->wait(Seconds(0.05));
    const auto found = device().poll();
    ASSERT_IN_TIME(found);
    EXPECT_FALSE(found->has_value());
}

TEST_P(OscilloscopeConformance, ACaptureIsWhatWasAskedFor) {
    ASSERT_IN_TIME(device().configure(usual()));
    ASSERT_IN_TIME(device().arm());
    if (!rig_->pulse()) GTEST_SKIP() << "this rig cannot make a pulse";
    const auto capture = captured();
    ASSERT_IN_TIME(capture);
    ASSERT_EQ(capture->channels.size(), 2U);
    EXPECT_EQ(capture->channels[0].unit, "V");
    EXPECT_EQ(capture->channels[1].unit, "A");
    for (const auto& channel : capture->channels) {
        EXPECT_EQ(channel.samples.size(), usual().samples);
        EXPECT_LT(channel.low, channel.high);
        EXPECT_GT(channel.lsb, 0);
    }
    EXPECT_DOUBLE_EQ(capture->rate_hz, usual().sampleRate.value());
    EXPECT_EQ(capture->simulated, device().identity().simulated);
    EXPECT_LE(capture->start_s + static_cast<double>(capture->samples()) / capture->rate_hz,
              toSeconds(rig_->clock().now()) + 1e-6);
}

TEST_P(OscilloscopeConformance, TheTriggerStandsWhereThePreTriggerSays) {
    ASSERT_IN_TIME(device().configure(usual()));
    ASSERT_IN_TIME(device().arm());
    if (!rig_->pulse()) GTEST_SKIP() << "this rig cannot make a pulse";
    const auto capture = captured();
    ASSERT_IN_TIME(capture);
    const double before = (capture->trigger_s - capture->start_s) * capture->rate_hz;
    EXPECT_NEAR(before, usual().preTrigger * static_cast<double>(usual().samples), 1.0);
    const auto at = static_cast<std::size_t>(std::ceil(before)) + 1;
    const auto& volts = capture->channels[0].samples;
    EXPECT_GT(std::abs(volts[at]), 5.0F);
    EXPECT_LT(std::abs(volts[at - 4]), 5.0F);
}

TEST_P(OscilloscopeConformance, EachPulseGivesOneCaptureUntilDisarmed) {
    ASSERT_IN_TIME(device().configure(usual()));
    ASSERT_IN_TIME(device().arm());
    double last = -1;
    for (int i = 0; i < 3; ++i) {
        if (!rig_->pulse()) GTEST_SKIP() << "this rig cannot make a pulse";
        const auto capture = captured();
        ASSERT_IN_TIME(capture);
        EXPECT_GT(capture->trigger_s, last);
        last = capture->trigger_s;
        EXPECT_FALSE(captured().has_value());
    }
    device().disarm();
    ASSERT_IN_TIME(rig_->pulse());
    EXPECT_FALSE(captured().has_value());
}

TEST_P(OscilloscopeConformance, AForcedRecordIsMarkedOverlapsNoOtherAndLeavesItWaiting) {
    auto* forced = dynamic_cast<ForcedTrigger*>(&device());
    if (forced == nullptr) GTEST_SKIP() << "this oscilloscope takes no record without a trigger";
    ASSERT_IN_TIME(device().configure(usual()));
    EXPECT_THAT(forced->forceTrigger(), refused(ErrorCode::Unsupported)) << "it is not armed";
    double free_s = toSeconds(rig_->clock().now());  // no record covers times from here on
    ASSERT_IN_TIME(device().arm());
    for (int i = 0; i < 2; ++i) {
        ASSERT_IN_TIME(forced->forceTrigger());
        const auto capture = captured();
        ASSERT_IN_TIME(capture);
        EXPECT_TRUE(capture->untriggered);
        EXPECT_TRUE(std::isnan(capture->trigger_s));
        EXPECT_EQ(capture->samples(), usual().samples);
        EXPECT_GE(capture->start_s, free_s - 1e-6);
        free_s = capture->start_s + static_cast<double>(capture->samples()) / capture->rate_hz;
        EXPECT_LE(free_s, toSeconds(rig_->clock().now()) + 1e-6);
        EXPECT_FALSE(captured().has_value()) << "one record for one call";
    }
    if (!rig_->pulse()) GTEST_SKIP() << "this rig cannot make a pulse";
    const auto triggered = captured();
    ASSERT_IN_TIME(triggered);
    EXPECT_FALSE(triggered->untriggered);
    EXPECT_GT(triggered->trigger_s, free_s);
}

TEST_P(OscilloscopeConformance, UnpluggedIsAnErrorAndNotACrash) {
    if (!rig_->unplug()) GTEST_SKIP() << "this rig cannot pull the plug";
    EXPECT_THAT(device().poll(), refused(ErrorCode::Device));
    EXPECT_FALSE(device().arm().has_value());
    if (auto* forced = dynamic_cast<ForcedTrigger*>(&device())) {
        EXPECT_FALSE(forced->forceTrigger().has_value());
    }
    device().disarm();
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OscilloscopeConformance);

}  // namespace tacto::test
