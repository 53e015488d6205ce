// Loads of known resistance and capacitance: the current is synthetic, and the voltage is computed from it.
#include <gtest/gtest.h>

#include "core/measure/LoadMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

constexpr double kCurrent_a = 5e-3;
constexpr double kWidth_s = 200e-6;
constexpr double kEdge_s = 2e-6;

struct Circuit {
    double series_ohm = 2000;
    double capacitance_f = 0;  ///< series capacitance; 0 = none
    double voltageNoise = 0;
    double currentNoise = 0;
    double voltageOffset = 0;
};

/// Computes v = R·i + ∫i dt / C with ten integration steps per sample.
Capture across(const Circuit& circuit, const std::vector<SyntheticPhase>& phases, std::size_t samples = 20'000) {
    auto capture = recordOf(phases, {.samples = samples, .noise = 0});
    capture.channels[0].lsb = 1e-9;  // stated, and finer than all other errors
    capture.channels[0].name = "current";
    capture.channels[0].unit = "A";
    auto& current = capture.channels[0].samples;
    CaptureChannel voltage;
    voltage.name = "voltage";
    voltage.unit = "V";
    voltage.lsb = 1e-6;
    voltage.gainTolerance = voltage.probeTolerance = 0;
    Random random(5, "load");
    double charge = 0;
    std::vector<StepResponse> steps;
    for (const auto& p : phases) steps.emplace_back(p);
    const auto currentAt = [&](double t) {
        double sum = 0;
        for (std::size_t k = 0; k < phases.size(); ++k) {
            if (std::abs(t - phases[k].onset_s) < 2 * kWidth_s) sum += valueAt(phases[k], steps[k], t);
        }
        return sum;
    };
    constexpr int kSteps = 10;
    const double dt = 1 / (capture.rate_hz * kSteps);
    for (std::size_t i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / capture.rate_hz;
        const double v = circuit.series_ohm * currentAt(t) +
                         (circuit.capacitance_f > 0 ? charge / circuit.capacitance_f : 0) + circuit.voltageOffset;
        voltage.samples.push_back(static_cast<float>(v + circuit.voltageNoise * random.normal()));
        for (int k = 0; k < kSteps; ++k) charge += currentAt(t + (k + 0.5) * dt) * dt;
        current[i] += static_cast<float>(circuit.currentNoise * random.normal());
    }
    capture.channels.push_back(std::move(voltage));
    return capture;
}

std::vector<SyntheticPhase> threePulses(double level = kCurrent_a) {
    std::vector<SyntheticPhase> phases;
    for (const double onset : {1e-3, 4e-3, 7e-3}) append(phases, biphasic(onset, level, kWidth_s, 100e-6, kEdge_s));
    return phases;
}

TEST(LoadMeasurement, AResistorIsItsResistanceAndItsHeat) {
    RecordProperty("hazard", "H9");
    const auto m = measureLoad(across({}, threePulses()), 1, 0).value();
    ASSERT_EQ(m.measuredPulses, 3U);
    EXPECT_NEAR(m.load_ohm.mean, 2000, 0.5);
    EXPECT_NEAR(m.impedance_ohm.mean, 2000, 0.5);
    EXPECT_NEAR(m.charge_c.mean, kCurrent_a * kWidth_s, 1e-3 * kCurrent_a * kWidth_s);
    EXPECT_NEAR(m.netCharge_c.mean, 0, 1e-4 * kCurrent_a * kWidth_s);
    // ∫i² of a trapezoid is I²·(width - edge/3).
    const double heat = 2 * 2000 * kCurrent_a * kCurrent_a * (kWidth_s - kEdge_s / 3);
    EXPECT_NEAR(m.energy_j.mean, heat, 2e-3 * heat);
    EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
}

TEST(LoadMeasurement, ACapacitorInSeriesAddsWhatItHasTakenUpByTheEnd) {
    const double farad = 200e-9;
    const auto m = measureLoad(across({.capacitance_f = farad}, threePulses()), 1, 0).value();
    ASSERT_EQ(m.measuredPulses, 3U);
    EXPECT_NEAR(m.load_ohm.mean, 2000 + kWidth_s / farad, 10);
    // The second phase takes out what the leading phase put into the capacitor; the heat stays in the resistor.
    const double heat = 2 * 2000 * kCurrent_a * kCurrent_a * (kWidth_s - kEdge_s / 3);
    EXPECT_NEAR(m.energy_j.mean, heat, 0.01 * heat);
    // The voltage is (R + t/C)·I, with t rising from 0 to the width in the first phase and falling back in the second.
    const double end = kWidth_s / farad;
    const double up = 2000.0 * 2000 + 2000 * end + end * end / 3;
    const double back = 2000.0 * 2000 - 2000 * end + end * end / 3;
    EXPECT_NEAR(m.impedance_ohm.mean, std::sqrt(0.5 * (up + back)), 15);
}

TEST(LoadMeasurement, NoiseAndOffsetMoveItByNoMoreThanItsUncertainty) {
    const Circuit noisy{.voltageNoise = 0.2, .currentNoise = 0.1e-3, .voltageOffset = 1.5};  // 34 dB
    std::vector<double> loads;
    double stated = 0;
    for (const double level : {kCurrent_a, 1.2 * kCurrent_a, 0.9 * kCurrent_a, -kCurrent_a}) {
        const auto m = measureLoad(across(noisy, threePulses(level)), 1, 0).value();
        ASSERT_EQ(m.measuredPulses, 3U);
        for (const auto& pulse : m.pulses) loads.push_back(pulse.load_ohm);
        stated = std::max(stated, m.loadUncertainty_ohm);
        EXPECT_NEAR(m.impedance_ohm.mean, 2000, 20) << "noise is not impedance";
    }
    const auto load = statisticsOf(loads);
    EXPECT_NEAR(load.mean, 2000, 2 * stated);
    EXPECT_LT(load.sd, 2 * stated);
    EXPECT_GT(load.sd, 0.3 * stated);
}

TEST(LoadMeasurement, ATurnedProbeIsANegativeLoadAndSaysSo) {
    RecordProperty("hazard", "H9");
    auto capture = across({}, threePulses());
    for (float& v : capture.channels[1].samples) v = -v;
    const auto m = measureLoad(capture, 1, 0).value();
    EXPECT_NEAR(m.load_ohm.mean, -2000, 1);
    ASSERT_EQ(m.warnings.size(), 1U);
    EXPECT_NE(m.warnings[0].find("wrong way round"), std::string::npos) << m.warnings[0];
}

TEST(LoadMeasurement, AClippedVoltageGivesNoLoad) {
    RecordProperty("hazard", "H9");
    auto phases = threePulses();
    phases[2].level = 2 * kCurrent_a;
    phases[3].level = -2 * kCurrent_a;
    auto capture = across({}, phases);
    auto& voltage = capture.channels[1];
    voltage.low = -15;
    voltage.high = 15;
    for (float& v : voltage.samples) v = std::clamp(v, -15.0F, 15.0F);
    const auto m = measureLoad(capture, 1, 0).value();
    ASSERT_EQ(m.pulses.size(), 3U);
    EXPECT_EQ(m.measuredPulses, 2U);
    EXPECT_TRUE(std::isnan(m.pulses[1].load_ohm));
    EXPECT_TRUE(std::isnan(m.pulses[1].energy_j));
    EXPECT_NEAR(m.load_ohm.max, 2000, 1);
    ASSERT_EQ(m.warnings.size(), 1U);
}

TEST(LoadMeasurement, RefusesChannelsInOtherUnitsAndFindsThePair) {
    auto capture = across({}, threePulses());
    EXPECT_EQ(measureLoad(capture, 0, 1).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(measureLoad(capture, 0, 1).error().message, "channel 'current' is in 'A'; V is expected");
    EXPECT_EQ(measureLoad(capture, 7, 0).error().code, ErrorCode::InvalidArgument);
    ASSERT_TRUE(loadChannels(capture));
    EXPECT_EQ(loadChannels(capture)->first, 1U);
    EXPECT_EQ(loadChannels(capture)->second, 0U);
    capture.channels.push_back(capture.channels[1]);
    EXPECT_FALSE(loadChannels(capture)) << "two voltages: which one is not for us to say";
    capture.channels.resize(1);
    EXPECT_FALSE(loadChannels(capture));
}

TEST(LoadMeasurement, WithoutPulsesItSaysThatThereIsNoLoad) {
    RecordProperty("hazard", "H9");
    const auto m = measureLoad(across({.voltageNoise = 0.1, .currentNoise = 1e-4}, {}), 1, 0).value();
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_TRUE(std::isnan(m.load_ohm.mean));
    EXPECT_EQ(m.warnings.size(), 1U);
}

}  // namespace
}  // namespace tacto::test
