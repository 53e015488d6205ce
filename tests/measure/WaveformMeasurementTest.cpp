// Measurements of the whole waveform, for signals whose truth follows from a formula.
#include <gtest/gtest.h>

#include "core/measure/WaveformMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

WaveformMeasurement measured(const Capture& capture, std::size_t channel = 0) {
    return measureWaveform(capture, channel, measureChannel(capture, channel));
}

Capture recordWith(double rate_hz, std::size_t samples, auto value) {
    Capture capture;
    capture.rate_hz = rate_hz;
    auto& channel = capture.channels.emplace_back();
    channel.name = "voltage";
    channel.unit = "V";
    for (std::size_t i = 0; i < samples; ++i) {
        channel.samples.push_back(static_cast<float>(value(static_cast<double>(i) / rate_hz)));
    }
    return capture;
}

TEST(WaveformMeasurement, ASineHasItsPeaksRmsAndFrequency) {
    // 25 whole periods of 250 Hz, around 3 V.
    const auto sine = recordWith(100e3, 10'000, [](double t) { return 3 + 2 * std::sin(2 * M_PI * 250 * t - 0.3); });
    const auto m = measured(sine);
    EXPECT_NEAR(m.peakToPeak, 4, 1e-3);
    EXPECT_NEAR(m.mean, 3, 1e-6);
    EXPECT_NEAR(m.rms, std::sqrt(9 + 2), 1e-6);
    EXPECT_NEAR(m.frequency_hz, 250, 0.01);
    EXPECT_NEAR(m.duty, 0.5, 1e-4);
}

TEST(WaveformMeasurement, ARectangleHasItsDutyWhicheverWayItGoes) {
    for (const double sign : {1.0, -1.0}) {
        std::vector<SyntheticPhase> phases;
        for (int k = 0; k < 9; ++k) {
            SyntheticPhase phase;
            phase.onset_s = (0.3 + k) * 1e-3;
            phase.width_s = 250e-6;
            phase.level = sign * 5;
            phases.push_back(phase);
        }
        SyntheticRecord record;
        record.noise = 0.05;
        const auto m = measured(recordOf(phases, record));
        EXPECT_EQ(m.periods, 8U);
        EXPECT_NEAR(m.frequency_hz, 1000, 0.2) << sign;
        EXPECT_NEAR(m.duty, 0.25, 2e-4) << sign;
        EXPECT_NEAR(m.mean, sign * 5 * 9 * 0.25 / 10, 0.01);
    }
}

TEST(WaveformMeasurement, ABiphasicPulseCountsItsLeadingPhaseAndNoneTwice) {
    std::vector<SyntheticPhase> phases;
    for (int k = 0; k < 3; ++k) append(phases, biphasic(1e-3 + k * 3e-3, 40));
    SyntheticRecord record;
    record.noise = 0.2;
    const auto m = measured(recordOf(phases, record));
    EXPECT_EQ(m.periods, 2U);
    EXPECT_NEAR(m.frequency_hz, 1 / 3e-3, 0.1);
    EXPECT_NEAR(m.duty, 200e-6 / 3e-3, 1e-4);
    EXPECT_NEAR(m.peakToPeak, 80, 2);
    EXPECT_NEAR(m.rms, 40 * std::sqrt(3 * 400e-6 / 10e-3), 0.1);
}

TEST(WaveformMeasurement, OnePulseHasNoFrequency) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(1e-3));
    const auto m = measured(recordOf(phases));
    EXPECT_TRUE(std::isnan(m.frequency_hz));
    EXPECT_TRUE(std::isnan(m.duty));
    EXPECT_TRUE(std::isfinite(m.rms));
}

TEST(WaveformMeasurement, ClippedLevelsAndMissingSamplesAreNotNumbers) {
    auto sine = recordWith(100e3, 10'000, [](double t) { return 2 * std::sin(2 * M_PI * 250 * t); });
    auto clipped = sine;
    clipped.channels[0].low = -1;
    clipped.channels[0].high = 1;
    for (auto& x : clipped.channels[0].samples) x = std::clamp(x, -1.0F, 1.0F);
    const auto c = measured(clipped);
    EXPECT_TRUE(c.clipped);
    EXPECT_TRUE(std::isnan(c.peakToPeak) && std::isnan(c.rms) && std::isnan(c.mean));
    EXPECT_NEAR(c.frequency_hz, 250, 0.1) << "its time is not lost";
    auto holed = sine;
    holed.channels[0].samples[5000] = NAN;
    const auto h = measured(holed);
    EXPECT_EQ(h.missing, 1U);
    EXPECT_NEAR(h.rms, std::sqrt(2.0), 1e-3);
    EXPECT_TRUE(std::isnan(h.frequency_hz)) << "a period may hide in the gap";
    auto nothing = sine;
    std::fill(nothing.channels[0].samples.begin(), nothing.channels[0].samples.end(), NAN);
    EXPECT_TRUE(std::isnan(measured(nothing).mean));
    EXPECT_TRUE(std::isnan(measured(recordWith(1e3, 100, [](double) { return 1.0; })).frequency_hz));
}

}  // namespace
}  // namespace tacto::test
