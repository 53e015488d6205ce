#include <gtest/gtest.h>

#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

std::vector<SyntheticPhase> threePulses() {
    auto phases = biphasic(1e-3);
    append(phases, biphasic(4e-3));
    append(phases, biphasic(7e-3));
    return phases;
}

void expectOnlyMiddleFlagged(const ChannelMeasurement& m) {
    ASSERT_EQ(m.pulses.size(), 3U);
    EXPECT_TRUE(m.pulses[0].flags.measured());
    EXPECT_FALSE(m.pulses[1].flags.measured());
    EXPECT_TRUE(m.pulses[2].flags.measured());
    EXPECT_EQ(m.measuredPulses, 2U);
    EXPECT_EQ(m.amplitude.n, 2U);
    EXPECT_TRUE(std::isnan(m.pulses[1].leading.plateau)) << "flagged means not measured";
    EXPECT_EQ(m.interval_s.n, 0U) << "an interval over a flagged pulse would be twice the truth";
    ASSERT_EQ(m.warnings.size(), 1U);
}

TEST(PulseFlags, AClippedPulseIsFlaggedAndNotMeasured) {
    RecordProperty("hazard", "H9");
    auto phases = threePulses();
    phases[2].level = 60;
    auto capture = recordOf(phases, {.noise = 0.1});
    auto& channel = capture.channels[0];
    channel.low = -50;
    channel.high = 50;
    for (float& x : channel.samples) x = std::clamp(x, -50.0F, 50.0F);
    const auto m = measureChannel(capture, 0);
    expectOnlyMiddleFlagged(m);
    EXPECT_TRUE(m.pulses[1].flags.clipped);
    // What is not measured can still be shown where it lies: both phases of it.
    EXPECT_NEAR(m.pulses[1].seenFrom_s, 4e-3, 2e-6);
    EXPECT_NEAR(m.pulses[1].seenTo_s, 4.5e-3, 2e-6);
}

TEST(PulseFlags, ClippingIsSeenWithoutADeclaredRange) {
    RecordProperty("hazard", "H9");
    auto phases = biphasic(1e-3, 60);
    auto capture = recordOf(phases, {.noise = 0.3});
    for (float& x : capture.channels[0].samples) x = std::clamp(x, -50.0F, 50.0F);
    const auto m = measureChannel(capture, 0);
    ASSERT_EQ(m.pulses.size(), 1U);
    EXPECT_TRUE(m.pulses[0].flags.clipped);
    EXPECT_EQ(m.measuredPulses, 0U);
}

TEST(PulseFlags, AnIdealOrCoarselyQuantisedPlateauIsNotCalledClipped) {
    EXPECT_EQ(measureChannel(recordOf(biphasic(1e-3)), 0).measuredPulses, 1U);
    auto capture = recordOf(biphasic(1e-3), {.noise = 0.1, .lsb = 0.39});
    capture.channels[0].lsb = 0;  // as read from a file
    EXPECT_EQ(measureChannel(capture, 0).measuredPulses, 1U);
}

TEST(PulseFlags, PulsesCutByTheRecordsEndsAreFlagged) {
    RecordProperty("hazard", "H9");
    auto phases = biphasic(-100e-6);  // begins before the record
    append(phases, biphasic(4e-3));
    append(phases, biphasic(9.75e-3));  // its second phase begins after the record: 50 us before the end is gap
    const auto m = measureChannel(recordOf(phases, {.noise = 0.1}), 0);
    ASSERT_EQ(m.pulses.size(), 3U);
    EXPECT_TRUE(m.pulses[0].flags.truncated);
    EXPECT_TRUE(m.pulses[1].flags.measured());
    EXPECT_TRUE(m.pulses[2].flags.truncated);
    EXPECT_EQ(m.measuredPulses, 1U);
}

TEST(PulseFlags, ARecordThatBeginsBetweenThePhasesDoesNotShiftThePairs) {
    std::vector<SyntheticPhase> phases{{50e-6, 200e-6, -40, 2e-6}};
    for (int k = 0; k < 4; ++k) append(phases, biphasic(0.6e-3 + k * 1e-3));
    const auto m = measureChannel(recordOf(phases, {.samples = 9000, .noise = 0.1}), 0);
    ASSERT_EQ(m.pulses.size(), 5U);
    EXPECT_TRUE(m.pulses[0].flags.truncated);
    for (std::size_t k = 1; k < 5; ++k) {
        ASSERT_TRUE(m.pulses[k].flags.measured()) << k;
        EXPECT_GT(m.pulses[k].leading.plateau, 0) << k;
        EXPECT_NEAR(m.pulses[k].gap_s, 100e-6, 0.2e-6) << k;
    }
}

TEST(PulseFlags, FewerThanTenSamplesInAPhaseAreNotMeasured) {
    RecordProperty("hazard", "H9");
    const auto at = [](double rate_hz) {
        return measureChannel(recordOf(biphasic(3e-3), {.rate_hz = rate_hz, .samples = 2000, .noise = 0.05}), 0);
    };
    const auto few = at(45e3);  // 9 samples a phase
    ASSERT_EQ(few.pulses.size(), 1U);
    EXPECT_TRUE(few.pulses[0].flags.underSampled);
    EXPECT_EQ(few.measuredPulses, 0U);
    ASSERT_EQ(few.warnings.size(), 1U);
    EXPECT_NE(few.warnings[0].find("fewer than 10 samples"), std::string::npos);

    const auto coarse = at(100e3);  // 20
    ASSERT_EQ(coarse.pulses.size(), 1U) << coarse.states.why;
    EXPECT_EQ(coarse.measuredPulses, 1U);
    EXPECT_TRUE(coarse.pulses[0].flags.coarse);
    EXPECT_GE(coarse.uncertainty.width_s, 1e-5 / std::sqrt(6.0));
    ASSERT_EQ(coarse.warnings.size(), 1U);
    EXPECT_NE(coarse.warnings[0].find("10 to 40 samples"), std::string::npos);

    const auto ample = at(250e3);  // 50
    ASSERT_EQ(ample.pulses.size(), 1U) << ample.states.why;
    EXPECT_FALSE(ample.pulses[0].flags.coarse);
    EXPECT_TRUE(ample.warnings.empty());
}

TEST(PulseFlags, APulseWithMissingSamplesIsNotMeasured) {
    RecordProperty("hazard", "H9");
    auto capture = recordOf(threePulses(), {.noise = 0.1});
    capture.channels[0].samples[8100] = std::nanf("");
    const auto m = measureChannel(capture, 0);
    expectOnlyMiddleFlagged(m);
    EXPECT_TRUE(m.pulses[1].flags.incomplete);
    // A hole in the silence harms no pulse.
    auto harmless = recordOf(threePulses(), {.noise = 0.1});
    harmless.channels[0].samples[15'800] = std::nanf("");
    EXPECT_EQ(measureChannel(harmless, 0).measuredPulses, 3U);
}

}  // namespace
}  // namespace tacto::test
