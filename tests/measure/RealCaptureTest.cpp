// Oscilloscope files made by others. Their dialects are an importer's business; here a few lines read the numbers.
#include <fstream>
#include <gtest/gtest.h>

#include "core/base/Text.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

/// Rows of numbers after `header` lines: column 0 is ignored, the rest are volts.
Capture numbersOf(const std::filesystem::path& path, int header, std::size_t channels, double rate_hz) {
    Capture capture;
    capture.rate_hz = rate_hz;
    for (std::size_t c = 0; c < channels; ++c) capture.channels.push_back({"CH" + std::to_string(c + 1), "V", {}});
    std::ifstream stream(path);
    std::string line;
    for (int k = 0; std::getline(stream, line);) {
        if (k++ < header) continue;
        const auto fields = split(line, ',');
        if (fields.size() < channels + 1) continue;
        for (std::size_t c = 0; c < channels; ++c) {
            capture.channels[c].samples.push_back(static_cast<float>(parseNumber(fields[c + 1]).value()));
        }
    }
    return capture;
}

TEST(RealCaptures, ARigolCalibratorSquareWave) {
    const auto path = sharedData("scope/rigol_DS2072A-1.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto m = measureCapture(numbersOf(*path, 2, 2, 200e3));
    for (const auto& channel : m.channels) {
        // Edges by numpy at every 100 samples of 5 us from sample 101 on: 1 kHz, half high; 8 codes of 40 mV steps.
        EXPECT_EQ(channel.states.count, StateCount::Two) << channel.name << channel.states.why;
        EXPECT_NEAR(channel.interval_s.mean, 1e-3, 1e-6) << channel.name;
        EXPECT_NEAR(channel.width_s.mean, 0.5e-3, 3e-6) << channel.name;
        EXPECT_NEAR(channel.amplitude.mean, 0.31, 0.015) << channel.name;
        EXPECT_EQ(channel.measuredPulses, 6U) << channel.name << ": 13 edges, of which the seventh pulse is cut";
    }
}

TEST(RealCaptures, ARigolSquareWaveWithRinging) {
    const auto path = sharedData("scope/rigol_DS1102E-B.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto m = measureChannel(numbersOf(*path, 2, 1, 50e6), 0);
    EXPECT_EQ(m.states.count, StateCount::Two) << m.states.why;
    EXPECT_EQ(m.measuredPulses, 5U);  // edges at 17-, 75+, 130-, 188+, 243-, 301+ ... 11 in all
    EXPECT_NEAR(m.interval_s.mean, 113.0 * 20e-9, 20e-9);
    EXPECT_NEAR(m.width_s.mean, 55.0 * 20e-9, 20e-9);
    EXPECT_NEAR(m.amplitude.mean, 5.5, 0.3);
}

TEST(RealCaptures, ATektronixRecordOfASerialBus) {
    const auto path = sharedData("scope/mdo4104c/RTC.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto m = measureCapture(numbersOf(*path, 21, 2, 50e6));
    const auto& clock = m.channels.at(1);
    ASSERT_EQ(clock.samples, 100'000U);
    EXPECT_EQ(clock.states.count, StateCount::Two);
    EXPECT_NEAR(clock.amplitude.mean, 5.05, 0.1);
    // 184 edges, the first one down: 92 low stretches or 91 high ones, by numpy with hysteresis.
    EXPECT_EQ(clock.measuredPulses, 91U);
    EXPECT_NEAR(clock.width_s.median, 5e-6, 0.2e-6);
    EXPECT_NEAR(clock.interval_s.median, 10e-6, 0.2e-6);
    const auto& data = m.channels.at(0);
    EXPECT_EQ(data.measuredPulses, 23U);  // 48 edges, the first one down
}

/// Widths between 50 % points by straight lines, levels by medians and means, sums of samples times the step: computed
/// once by a few lines of Python that share nothing with this code.
TEST(RealCaptures, AgreesWithASecondProgram) {
    const auto bus = sharedData("scope/mdo4104c/RTC.csv");
    if (!bus) GTEST_SKIP() << kNoSharedData;
    const auto busCapture = numbersOf(*bus, 21, 2, 50e6);
    const auto clock = measureChannel(busCapture, 1);
    EXPECT_NEAR(clock.width_s.median, 5.03275e-6, 4e-9);
    EXPECT_NEAR(clock.width_s.mean, 5.25798e-6, 4e-9);
    EXPECT_NEAR(clock.interval_s.median, 10.0007e-6, 2e-9);
    EXPECT_NEAR(clock.amplitude.mean, 5.0176, 0.003);
    EXPECT_NEAR(clock.charge.median, 2.5143e-5, 0.5e-7);
    EXPECT_NEAR(clock.states.noise, 0.0754, 0.005);
    EXPECT_EQ(clock.quality.mean, 1U) << "37 dB need no averaging";
    const auto data = measureChannel(busCapture, 0);
    EXPECT_NEAR(data.width_s.median, 10.0318e-6, 4e-9);
    EXPECT_NEAR(data.width_s.mean, 12.2191e-6, 6e-9);
    EXPECT_NEAR(data.amplitude.mean, 4.898, 0.012) << "it has glitches, whose plateau is a matter of taste";
    EXPECT_NEAR(data.charge.median, 4.9205e-5, 2e-7);

    const auto calibrator = numbersOf(*sharedData("scope/rigol_DS2072A-1.csv"), 2, 2, 200e3);
    const double amplitudes[] = {0.29876, 0.30326};
    for (std::size_t c = 0; c < 2; ++c) {
        const auto m = measureChannel(calibrator, c);
        EXPECT_NEAR(m.amplitude.mean, amplitudes[c], 0.0003);
        EXPECT_NEAR(m.width_s.mean, 0.50008e-3, 0.25e-6);
        EXPECT_NEAR(m.interval_s.mean, 1e-3, 1e-8);
        EXPECT_NEAR(m.charge.median, amplitudes[c] * 0.5e-3, 1e-6);
    }
    const auto ringing = measureChannel(numbersOf(*sharedData("scope/rigol_DS1102E-B.csv"), 2, 1, 50e6), 0);
    EXPECT_NEAR(ringing.width_s.median, 1.08639e-6, 1e-9);
    EXPECT_NEAR(ringing.interval_s.median, 2.25947e-6, 1e-9);
    EXPECT_NEAR(ringing.amplitude.mean, 5.667, 0.01);
}

TEST(RealCaptures, SlowDriftsAndNoiseHaveNoPulses) {
    RecordProperty("hazard", "H9");
    const auto path = sharedData("scope/rigol_DS1074Z-A.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    for (const auto& channel : measureCapture(numbersOf(*path, 2, 3, 50e3)).channels) {
        EXPECT_EQ(channel.measuredPulses, 0U) << channel.name;
        EXPECT_FALSE(channel.warnings.empty()) << channel.name;
    }
    const auto noise = sharedData("scope/rigol_DS4024-B.csv");
    ASSERT_TRUE(noise);
    const auto m = measureChannel(numbersOf(*noise, 2, 2, 100e3), 1);
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_FALSE(m.warnings.empty());
}

}  // namespace
}  // namespace tacto::test
