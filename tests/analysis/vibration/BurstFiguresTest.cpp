// Bursts of known strength, latency, rise and rhythm, as an accelerometer would measure them.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "core/analysis/vibration/BurstFigures.h"
#include "core/base/Random.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

constexpr double kRate = 4000, kGravity = 9.81, kHertz = 100;

struct Shaking {
    double amplitude = 4;     // m/s²
    double latency_s = 0.02;  // latency of every burst
    double ramp_s = 0;        // time to reach the amplitude
    double noise = 0;         // per axis
};

/// Returns three bursts 0.5 s apart, from 1 s on, of 10 whole turns each. Their direction differs from gravity.
std::vector<CommandedBurst> commands() {
    std::vector<CommandedBurst> all;
    for (int k = 0; k < 3; ++k) all.push_back({1 + k * 0.5, Seconds(0.1)});
    return all;
}

std::vector<AccelerationSample> record(const Shaking& shaking) {
    std::vector<AccelerationSample> out;
    Random random(7, "noise of an accelerometer");
    for (int i = 0; i < static_cast<int>(3 * kRate); ++i) {
        const double t = i / kRate;
        double a = 0;
        for (const auto& burst : commands()) {
            const double since = t - burst.onset_s - shaking.latency_s;
            if (since < 0 || since >= 0.1) continue;
            const double grown = shaking.ramp_s > 0 ? std::min(1.0, since / shaking.ramp_s) : 1;
            a = shaking.amplitude * grown * std::sin(2 * std::numbers::pi * kHertz * since);
        }
        const auto axis = [&] { return shaking.noise * random.normal(); };
        out.push_back({t, 0.6 * a + axis(), axis(), kGravity + 0.8 * a + axis()});
    }
    return out;
}

TEST(BurstFigures, SaysWhatTheMotorDid) {
    const auto found = test::accepted(burstFigures(record({}), commands()));
    EXPECT_EQ(found.bursts, 3U);
    EXPECT_EQ(found.moved, 3U);
    EXPECT_EQ(found.missed, 0U);
    EXPECT_NEAR(found.strength_m_s2, 4 / std::numbers::sqrt2, 0.02);
    EXPECT_NEAR(found.latency_s, 0.02, 0.0005);
    EXPECT_NEAR(found.interval_s, 0.5, 1e-9);
    // A sine reaches a tenth of its peak 0.16 ms after it begins, and nine tenths after 1.78 ms.
    EXPECT_NEAR(found.rise_s, 0.00162, 0.0003);
    EXPECT_NEAR(found.noise_m_s2, 0, 1e-9);
}

TEST(BurstFigures, SlowMotorsRiseSlowly) {
    const auto found = test::accepted(burstFigures(record({.ramp_s = 0.03}), commands()));
    // The rise runs from 5.9 ms, when t/30 ms · |sin| passes 0.1, to 27.2 ms, when it passes 0.9.
    EXPECT_NEAR(found.rise_s, 0.0214, 0.001);
}

TEST(BurstFigures, NoiseIsTakenOffAndStatedAsUncertainty) {
    const auto found = test::accepted(burstFigures(record({.amplitude = 1, .noise = 0.05}), commands()));
    EXPECT_EQ(found.moved, 3U);
    EXPECT_NEAR(found.noise_m_s2, 0.05 * std::sqrt(3), 0.006);
    EXPECT_GT(found.strengthUncertainty_m_s2, 0);
    EXPECT_NEAR(found.strength_m_s2, 1 / std::numbers::sqrt2, 6 * found.strengthUncertainty_m_s2);
    EXPECT_GT(found.intervalUncertainty_s, 0);
    EXPECT_NEAR(found.interval_s, 0.5, 0.002);
}

TEST(BurstFigures, AMotorThatStandsStillIsNoZeroStrength) {
    RecordProperty("hazard", "H9");
    const auto found = test::accepted(burstFigures(record({.amplitude = 0, .noise = 0.05}), commands()));
    EXPECT_EQ(found.moved, 0U);
    EXPECT_EQ(found.missed, 0U);
    EXPECT_TRUE(std::isnan(found.strength_m_s2));
    EXPECT_TRUE(std::isnan(found.interval_s));
    EXPECT_TRUE(std::isnan(found.latency_s));
}

TEST(BurstFigures, WhereSamplesAreMissingNothingWasMeasured) {
    RecordProperty("hazard", "H9");
    auto samples = record({});
    std::erase_if(samples, [](const AccelerationSample& each) { return each.t_s > 1.53 && each.t_s < 1.56; });
    const auto found = test::accepted(burstFigures(samples, commands()));
    EXPECT_EQ(found.moved, 2U);
    EXPECT_EQ(found.missed, 1U);
    EXPECT_TRUE(std::isnan(found.interval_s)) << "none follows another that was measured";
    auto spoilt = record({});
    spoilt[static_cast<std::size_t>(1.54 * kRate)].x = kNaN;
    const auto withNaN = test::accepted(burstFigures(spoilt, commands()));
    EXPECT_EQ(withNaN.missed, 1U);
    auto ended = record({});
    std::erase_if(ended, [](const AccelerationSample& each) { return each.t_s > 2.05; });
    EXPECT_EQ(burstFigures(ended, commands()).value().missed, 1U) << "before the last had run down";
}

TEST(BurstFigures, NeedsTheQuietBeforeTheFirst) {
    auto samples = record({});
    std::erase_if(samples, [](const AccelerationSample& each) { return each.t_s < 0.95; });
    EXPECT_EQ(burstFigures(samples, commands()).error().code, ErrorCode::NotFound);
    EXPECT_EQ(burstFigures({}, commands()).error().code, ErrorCode::NotFound);
}

TEST(BurstFigures, RefusesWhatCannotBe) {
    const auto samples = record({});
    EXPECT_EQ(burstFigures(samples, {}).error().code, ErrorCode::InvalidArgument);
    auto back = commands();
    std::swap(back[0], back[1]);
    EXPECT_EQ(burstFigures(samples, back).error().code, ErrorCode::InvalidArgument);
    for (const double wrong : {0.0, kNaN}) {
        auto bursts = commands();
        bursts[1].duration = Seconds(wrong);
        EXPECT_EQ(burstFigures(samples, bursts).error().code, ErrorCode::InvalidArgument) << wrong;
    }
    auto twice = samples;
    twice[5].t_s = twice[4].t_s;
    EXPECT_EQ(burstFigures(twice, commands()).error().code, ErrorCode::InvalidArgument);
    twice[5].t_s = kNaN;
    EXPECT_EQ(burstFigures(twice, commands()).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace tacto
