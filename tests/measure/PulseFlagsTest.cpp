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
    // The place of an unmeasured pulse is still known, with both phases.
    EXPECT_NEAR(m.pulses[1].seenFrom_s, 4e-3, 2e-6);
    EXPECT_NEAR(m.pulses[1].seenTo_s, 4.5e-3, 2e-6);
}

/// Highest code of an 8-bit converter.
constexpr double kCodes = 127;

/// Returns a record of an 8-bit oscilloscope with this range, with noise added before its converter.
Capture digitised(std::vector<SyntheticPhase> phases, double range, double noise) {
    auto capture = recordOf(phases, {.noise = noise});
    const double lsb = range / kCodes;
    for (float& x : capture.channels[0].samples) {
        const double code = std::clamp(std::round(static_cast<double>(x) / lsb), -kCodes, kCodes);
        x = static_cast<float>(code * lsb);
    }
    return capture;
}

TEST(PulseFlags, ClippingIsKnownFromTheStatedRangeAndNotFromTheRecordsOwnMaximum) {
    RecordProperty("hazard", "H9");
    auto capture = digitised(biphasic(1e-3, 60), 50, 0.6);
    auto unstated = measureChannel(capture, 0);
    ASSERT_EQ(unstated.pulses.size(), 1U);
    EXPECT_FALSE(unstated.pulses[0].flags.clipped);
    EXPECT_TRUE(unstated.pulses[0].flags.flatTop);
    EXPECT_EQ(unstated.measuredPulses, 1U);
    ASSERT_EQ(unstated.warnings.size(), 1U) << "a record that is really clipped is not measured without remark";
    EXPECT_NE(unstated.warnings[0].find("1 pulse with a flat top"), std::string::npos) << unstated.warnings[0];
    EXPECT_NE(unstated.warnings[0].find("may be clipped"), std::string::npos);

    auto& channel = capture.channels[0];
    channel.low = -50;
    channel.high = 50;
    channel.lsb = 50 / kCodes;
    const auto stated = measureChannel(capture, 0);
    ASSERT_EQ(stated.pulses.size(), 1U);
    EXPECT_TRUE(stated.pulses[0].flags.clipped);
    EXPECT_FALSE(stated.pulses[0].flags.flatTop);
    EXPECT_EQ(stated.measuredPulses, 0U);

    channel.low = -60;  // the stated range leaves more than enough room
    channel.high = 60;
    const auto roomy = measureChannel(capture, 0);
    EXPECT_EQ(roomy.measuredPulses, 1U);
    EXPECT_TRUE(roomy.warnings.empty()) << "the stated range says that nothing is missing";
}

TEST(PulseFlags, OnlyTheLastCodeIsFullScale) {
    RecordProperty("hazard", "H9");
    for (const double code : {125.0, 126.0, 127.0, -126.0, -127.0}) {
        auto capture = digitised(biphasic(1e-3, code / kCodes * 50), 50, 0);
        auto& channel = capture.channels[0];
        channel.low = -50;
        channel.high = 50;
        channel.lsb = 50 / kCodes;
        const auto m = measureChannel(capture, 0);
        ASSERT_EQ(m.pulses.size(), 1U) << code;
        EXPECT_EQ(m.pulses[0].flags.clipped, std::abs(code) == kCodes) << code;
        channel.lsb = 0;  // the range alone is enough
        EXPECT_EQ(measureChannel(capture, 0).pulses[0].flags.clipped, std::abs(code) == kCodes) << code;
    }
}

TEST(PulseFlags, AClippedRecordIsRemarkedOnWhateverItsNoise) {
    RecordProperty("hazard", "H9");
    const double lsb = 50 / kCodes;
    for (const double noise : {0.35, 0.5, 1.0, 3.0}) {
        auto phases = biphasic(1e-3, 70);
        append(phases, biphasic(4e-3, 70));
        for (auto& phase : phases) phase.level += phase.level > 0 ? 0.2 : 0;  // all levels are different
        auto capture = digitised(phases, 50, noise * lsb);
        const auto m = measureChannel(capture, 0);
        ASSERT_EQ(m.pulses.size(), 2U) << noise;
        EXPECT_TRUE(m.pulses[0].flags.flatTop && m.pulses[1].flags.flatTop) << noise;
        // Nothing is reported if the range leaves room.
        auto whole = digitised(phases, 100, 2 * noise * lsb);
        for (const auto& pulse : measureChannel(whole, 0).pulses) EXPECT_FALSE(pulse.flags.flatTop) << noise;
    }
}

TEST(PulseFlags, OneFlatPulseAmongSmallerOnesIsTheOneThatIsRemarkedOn) {
    RecordProperty("hazard", "H9");
    auto phases = threePulses();
    phases[2].level = 60;
    const auto m = measureChannel(digitised(phases, 50, 0.5), 0);
    ASSERT_EQ(m.pulses.size(), 3U);
    EXPECT_FALSE(m.pulses[0].flags.flatTop);
    EXPECT_TRUE(m.pulses[1].flags.flatTop);
    EXPECT_FALSE(m.pulses[2].flags.flatTop);
    EXPECT_EQ(m.measuredPulses, 3U);
}

/// Counts flat-top warnings on clean records, with levels anywhere between two codes, and on clipped records.
TEST(PulseFlags, FlatTopsAreRemarkedOnWhereTheyAreClippedAndHardlyElsewhere) {
    RecordProperty("hazard", "H9");
    constexpr int kRecords = 20;
    for (const double noise : {0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 2.0}) {
        int clean = 0;
        int clipped = 0;
        for (int k = 0; k < kRecords; ++k) {
            const double level = 30 + 0.411 * k;
            const auto flat = [&](double range) {
                auto phases = biphasic(1e-3, level);
                auto capture =
                    recordOf(phases, {.noise = noise * range / kCodes, .seed = static_cast<unsigned>(k + 1)});
                const double lsb = range / kCodes;
                const double offset = 0.273 * k * lsb;  // position of the baseline between two codes
                for (float& x : capture.channels[0].samples) {
                    x = static_cast<float>(
                        std::clamp(std::round((static_cast<double>(x) + offset) / lsb), -kCodes, kCodes) * lsb);
                }
                const auto m = measureChannel(capture, 0);
                return m.pulses.size() == 1 && m.pulses[0].flags.flatTop;
            };
            clean += flat(50) ? 1 : 0;
            clipped += flat(25) ? 1 : 0;
        }
        // With noise below a third of a code, a clean and a clipped top can look the same.
        EXPECT_LE(clean, noise < 0.3 ? kRecords / 5 : 0) << noise << " codes";
        EXPECT_GE(clipped, noise < 0.4 ? 0 : kRecords) << noise << " codes";
    }
}

TEST(PulseFlags, ACleanWaveOfTwoCodesPerLevelIsNeitherClippedNorFlat) {
    // A record of a Rigol DS2072A's own calibrator: each level dithers between two codes, and half of the upper samples
    // are the record's maximum.
    Capture capture;
    capture.rate_hz = 200e3;
    capture.trigger_s = std::nan("");
    auto& channel = capture.channels.emplace_back();
    channel.name = "CH1";
    channel.unit = "V";
    std::uint32_t state = 1;
    for (int i = 0; i < 1400; ++i) {
        state = state * 1664525U + 1013904223U;
        const bool upper = (state >> 24U) < 115;
        channel.samples.push_back(((i / 100) % 2 == 0 ? 0.008F : 0.304F) + (upper ? 0.016F : 0.0F));
    }
    const auto m = measureChannel(capture, 0);
    EXPECT_EQ(m.measuredPulses, 6U);
    for (const auto& pulse : m.pulses) EXPECT_FALSE(pulse.flags.clipped || pulse.flags.flatTop);
    EXPECT_NEAR(m.amplitude.mean, 0.296, 0.008) << "half a step of 16 mV";
}

TEST(PulseFlags, AnIdealOrCoarselyQuantisedPlateauIsNotCalledClipped) {
    EXPECT_EQ(measureChannel(recordOf(biphasic(1e-3)), 0).measuredPulses, 1U);
    auto capture = recordOf(biphasic(1e-3), {.noise = 0.1, .lsb = 0.39});
    capture.channels[0].lsb = 0;  // unknown, as when read from a file
    EXPECT_EQ(measureChannel(capture, 0).measuredPulses, 1U);
}

TEST(PulseFlags, PulsesCutByTheRecordsEndsAreFlagged) {
    RecordProperty("hazard", "H9");
    auto phases = biphasic(-100e-6);  // begins before the start of the record
    append(phases, biphasic(4e-3));
    append(phases, biphasic(9.75e-3));  // the second phase begins after the record, whose last 50 us are the gap
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
    const auto few = at(45e3);  // 9 samples per phase
    ASSERT_EQ(few.pulses.size(), 1U);
    EXPECT_TRUE(few.pulses[0].flags.underSampled);
    EXPECT_EQ(few.measuredPulses, 0U);
    ASSERT_EQ(few.warnings.size(), 1U);
    EXPECT_NE(few.warnings[0].find("fewer than 10 samples"), std::string::npos);

    const auto coarse = at(100e3);  // 20 samples per phase
    ASSERT_EQ(coarse.pulses.size(), 1U) << coarse.states.why;
    EXPECT_EQ(coarse.measuredPulses, 1U);
    EXPECT_TRUE(coarse.pulses[0].flags.coarse);
    EXPECT_GE(coarse.uncertainty.width_s, 1e-5 / std::sqrt(6.0));
    ASSERT_EQ(coarse.warnings.size(), 1U);
    EXPECT_NE(coarse.warnings[0].find("10 to 40 samples"), std::string::npos);

    const auto ample = at(250e3);  // 50 samples per phase
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
    // Missing samples in the silence do not affect the pulses.
    auto harmless = recordOf(threePulses(), {.noise = 0.1});
    harmless.channels[0].samples[15'800] = std::nanf("");
    EXPECT_EQ(measureChannel(harmless, 0).measuredPulses, 3U);
}

}  // namespace
}  // namespace tacto::test
