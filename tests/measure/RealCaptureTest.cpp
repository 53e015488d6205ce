// Oscilloscope files from others, compared with numpy (tests/reference/real_captures.py). This test does not use the
// importers; a few lines here read the numbers.
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/LocaleFreeText.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/support/Figures.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

/// Reads rows of numbers after `header` lines. Column 0 is ignored; the others are in volts.
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

/// Expects a square wave: two states, the same number of pulses, and widths and intervals to 1/100 of a sampling step.
void expectNumpys(const ChannelMeasurement& m, const nlohmann::json& numpy) {
    EXPECT_EQ(m.states.count, StateCount::Two) << m.name << m.states.why;
    EXPECT_EQ(m.measuredPulses, numpy.at("pulses").get<std::size_t>()) << m.name;
    const double step = 0.01 / m.rate_hz;
    EXPECT_NEAR(m.width_s.median, numpy.at("width_median_s").get<double>(), step) << m.name;
    EXPECT_NEAR(m.width_s.mean, numpy.at("width_mean_s").get<double>(), step) << m.name;
    EXPECT_NEAR(m.interval_s.median, numpy.at("interval_median_s").get<double>(), step) << m.name;
    EXPECT_NEAR(m.interval_s.mean, numpy.at("interval_mean_s").get<double>(), step) << m.name;
    const auto amplitude = numpy.at("amplitude_mean").get<double>(), charge = numpy.at("charge_median").get<double>();
    EXPECT_NEAR(m.amplitude.mean, amplitude, 0.0005 * amplitude) << m.name;
    // The tolerance covers the baseline's noise over half a gap.
    EXPECT_NEAR(m.charge.median, charge, 0.002 * charge) << m.name;
}

TEST(RealCaptures, ARigolCalibratorSquareWave) {
    const auto path = sharedData("scope/rigol_DS2072A-1.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto m = measureCapture(numbersOf(*path, 2, 2, 200e3));
    for (std::size_t c = 0; c < 2; ++c) {
        // 13 edges, because the seventh pulse is cut off.
        expectNumpys(m.channels.at(c), figuresOf("real_captures").at("calibrator").at(c));
    }
}

TEST(RealCaptures, ARigolSquareWaveWithRinging) {
    const auto path = sharedData("scope/rigol_DS1102E-B.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    expectNumpys(measureChannel(numbersOf(*path, 2, 1, 50e6), 0), figuresOf("real_captures").at("ringing"));
}

TEST(RealCaptures, ATektronixRecordOfASerialBus) {
    const auto path = sharedData("scope/mdo4104c/RTC.csv");
    if (!path) GTEST_SKIP() << kNoSharedData;
    const auto m = measureCapture(numbersOf(*path, 21, 2, 50e6));
    const auto& data = m.channels.at(0);
    const auto& clock = m.channels.at(1);
    ASSERT_EQ(clock.samples, 100'000U);
    EXPECT_EQ(clock.quality.mean, 1U) << "37 dB need no averaging";
    // Each record begins high, so the first stretch has only one edge.
    const auto& numpy = figuresOf("real_captures").at("bus_clock");
    expectNumpys(clock, numpy);
    EXPECT_NEAR(clock.states.noise, numpy.at("noise").get<double>(), 0.005);
    expectNumpys(data, figuresOf("real_captures").at("bus_data"));
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
