#include <gtest/gtest.h>

#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

TEST(PulseMeasurement, PlacesEdgesBetweenSamples) {
    // The onsets sweep through a sampling step. Edges of 6 us last 12 steps, so that interpolation is exact at all
    // three references; the charge lacks the corners that a step cuts off.
    for (int k = 0; k < 20; ++k) {
        const double onset = 1e-3 + k * 0.5e-6 / 20 + 1.3e-8;
        const double width = 200e-6 + k * 0.37e-7;
        const auto m = measureChannel(recordOf({{onset, width, 25, 6e-6}}), 0);
        ASSERT_EQ(m.measuredPulses, 1U);
        const auto& phase = m.pulses[0].leading;
        EXPECT_NEAR(phase.onset_s, onset, 1e-11) << k;
        EXPECT_NEAR(phase.width_s, width, 2e-11) << k;
        EXPECT_NEAR(phase.plateau, 25, 1e-5);
        EXPECT_NEAR(phase.rise_s, 0.8 * 6e-6, 1e-11);
        EXPECT_NEAR(phase.fall_s, 0.8 * 6e-6, 1e-11);
        EXPECT_NEAR(phase.charge, 25 * width, 3e-7);
        EXPECT_NEAR(phase.overshoot, 0, 1e-6);
        EXPECT_NEAR(phase.droop, 0, 1e-6);
        EXPECT_FALSE(m.pulses[0].second);
        EXPECT_TRUE(std::isnan(m.pulses[0].imbalance)) << "a monophasic pulse has no imbalance to be zero";
    }
}

TEST(PulseMeasurement, ImbalanceIsTheDifferenceOverTheLargerCharge) {
    RecordProperty("hazard", "H5");
    const auto m =
        measureChannel(recordOf({{1e-3, 200e-6, 40, 2e-6}, {1.3e-3, 200e-6, -36, 2e-6}}, {.noise = 0.05}), 0);
    ASSERT_EQ(m.measuredPulses, 1U);
    EXPECT_NEAR(m.pulses[0].imbalance, 0.1, 2e-3);
    EXPECT_EQ(m.imbalance.n, 1U);
}

TEST(PulseMeasurement, AMissingSecondPhaseIsAnImbalanceOfOne) {
    RecordProperty("hazard", "H5");
    auto phases = biphasic(1e-3);
    append(phases, {{4e-3, 200e-6, 40, 2e-6}});
    append(phases, biphasic(7e-3));
    const auto m = measureChannel(recordOf(phases, {.noise = 0.1}), 0);
    ASSERT_EQ(m.measuredPulses, 3U);
    EXPECT_FALSE(m.pulses[1].second);
    EXPECT_DOUBLE_EQ(m.pulses[1].imbalance, 1);
    ASSERT_EQ(m.warnings.size(), 1U);
    EXPECT_NE(m.warnings[0].find("without a second phase"), std::string::npos);
}

TEST(PulseMeasurement, ANegativeLeadingPhaseKeepsItsSignAndGivesAMagnitude) {
    const auto m = measureChannel(recordOf(biphasic(1e-3, -20), {.noise = 0.1}), 0);
    ASSERT_EQ(m.measuredPulses, 1U);
    EXPECT_NEAR(m.pulses[0].leading.plateau, -20, 0.05);
    EXPECT_NEAR(m.amplitude.mean, 20, 0.05);
    EXPECT_EQ(m.trains[0].polarity, -1);
    EXPECT_NEAR(m.pulses[0].leading.rise_s, 1.6e-6, 0.1e-6) << "the leading edge is the rise, also downwards";
}

TEST(PulseMeasurement, OvershootAndDroopAreFractionsOfThePlateau) {
    const auto over = measureChannel(recordOf({{1e-3, 1e-3, 10, 2e-6, 0, 0.2}}), 0);
    ASSERT_EQ(over.measuredPulses, 1U);
    EXPECT_NEAR(over.pulses[0].leading.plateau, 10, 0.01);
    EXPECT_NEAR(over.pulses[0].leading.overshoot, 0.2 * std::exp(-1.0 / 30), 0.02);
    const auto droop = measureChannel(recordOf({{1e-3, 1e-3, 10, 2e-6, 0.08}}), 0);
    ASSERT_EQ(droop.measuredPulses, 1U);
    EXPECT_NEAR(droop.pulses[0].leading.plateau, 10, 0.01) << "the middle of the plateau's window";
    EXPECT_NEAR(droop.pulses[0].leading.droop, 0.08, 1e-4);
}

TEST(PulseMeasurement, LogicIsMeasuredAsZeroAndOne) {
    auto capture = recordOf({{1e-3, 3e-3, 1, 1e-9}, {5e-3, 3e-3, 1, 1e-9}});
    capture.channels[0].unit = "";
    const auto m = measureChannel(capture, 0);
    EXPECT_EQ(m.measuredPulses, 2U);
    EXPECT_DOUBLE_EQ(m.amplitude.mean, 1);
    EXPECT_NEAR(m.width_s.mean, 3e-3, 0.5e-6);
    EXPECT_NEAR(m.interval_s.mean, 4e-3, 0.5e-6);
}

TEST(PulseMeasurement, NoiseMovesReadingsByNoMoreThanTheStatedUncertainty) {
    // The spread of the readings over 200 records is the true uncertainty.
    std::vector<double> amplitudes, widths;
    MeasurementUncertainty u;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        const double onset = 1e-3 + seed * 0.5e-6 / 200;
        const auto m = measureChannel(recordOf(biphasic(onset, 40, 200e-6, 100e-6, 1e-7),
                                               {.samples = 4000, .noise = 0.4, .lsb = 1e-3, .seed = seed}),
                                      0);
        ASSERT_EQ(m.measuredPulses, 1U) << seed;
        amplitudes.push_back(m.pulses[0].leading.plateau);
        widths.push_back(m.pulses[0].leading.width_s);
        u = m.uncertainty;
    }
    const auto amplitude = statisticsOf(amplitudes);
    EXPECT_NEAR(amplitude.mean, 40, 0.01);
    EXPECT_GT(u.amplitude, 0.7 * amplitude.sd);
    EXPECT_LT(u.amplitude, 2 * amplitude.sd);
    EXPECT_NEAR(statisticsOf(widths).mean, 200e-6, 1e-7);
    EXPECT_GE(u.width_s, statisticsOf(widths).sd);
    EXPECT_NEAR(u.width_s, 0.5e-6 / std::sqrt(6.0), 0.05e-6);
}

TEST(PulseMeasurement, UncertaintyAddsWhatTheChannelDeclares) {
    auto capture = recordOf(biphasic(1e-3));
    auto& channel = capture.channels[0];
    channel.lsb = 0.39;
    channel.gainTolerance = 0.02;
    channel.probeTolerance = 0.01;
    channel.offsetTolerance = 0.1;  // the baseline has the same offset, so the offset cancels
    capture.timeBaseTolerance = 1e-3;
    const auto m = measureChannel(capture, 0);
    const double expected =
        std::sqrt((0.39 * 0.39) / 6 + (0.02 * 40) * (0.02 * 40) / 3 + (0.01 * 40) * (0.01 * 40) / 3);
    EXPECT_NEAR(m.uncertainty.amplitude, expected, 1e-4);
    EXPECT_GE(m.uncertainty.width_s, 1e-3 * 200e-6 / std::sqrt(3.0));
}

TEST(PulseMeasurement, WhatTheInstrumentDoesNotStateLeavesNoUncertainty) {
    RecordProperty("hazard", "H9");
    auto complete = recordOf(biphasic(1e-3));
    complete.channels[0].lsb = 0.39;
    complete.channels[0].gainTolerance = complete.channels[0].probeTolerance = 0;
    complete.timeBaseTolerance = 0;
    EXPECT_TRUE(std::isfinite(measureChannel(complete, 0).uncertainty.amplitude));
    for (double CaptureChannel::*missing : {&CaptureChannel::gainTolerance, &CaptureChannel::probeTolerance}) {
        auto capture = complete;
        capture.channels[0].*missing = kNaN;
        EXPECT_TRUE(std::isnan(measureChannel(capture, 0).uncertainty.amplitude));
        EXPECT_TRUE(std::isfinite(measureChannel(capture, 0).uncertainty.width_s));
    }
    auto capture = complete;
    capture.timeBaseTolerance = kNaN;
    EXPECT_TRUE(std::isnan(measureChannel(capture, 0).uncertainty.width_s));
    EXPECT_TRUE(std::isfinite(measureChannel(capture, 0).uncertainty.amplitude));
}

TEST(PulseMeasurement, NothingToMeasureIsSaidAndNotInvented) {
    RecordProperty("hazard", "H9");
    const auto m = measureChannel(recordOf({}, {.noise = 0.1}), 0);
    EXPECT_EQ(m.pulses.size(), 0U);
    EXPECT_EQ(m.amplitude.n, 0U);
    EXPECT_TRUE(std::isnan(m.amplitude.mean));
    EXPECT_TRUE(std::isnan(m.uncertainty.amplitude));
    ASSERT_EQ(m.warnings.size(), 1U);
    EXPECT_NE(m.warnings[0].find("'voltage' has no two states"), std::string::npos) << m.warnings[0];
}

TEST(PulseMeasurement, AHalfSineTrainRestsOnNoPlateauAndIsNotCalledAPulse) {
    RecordProperty("hazard", "H9");
    std::vector<SyntheticPhase> phases;
    for (int k = 0; k < 4; ++k) phases.push_back({1e-3 + k * 2e-3, 400e-6, 5, 400e-6});  // triangles
    const auto m = measureChannel(recordOf(phases, {.noise = 0.01}), 0);
    EXPECT_EQ(m.measuredPulses, 0U);
    EXPECT_EQ(m.warnings.size(), 1U);
}

TEST(PulseMeasurement, MeasuresOneChannelOrAll) {
    auto capture = recordOf(biphasic(1e-3));
    capture.channels.push_back(capture.channels[0]);
    capture.channels[1].name = "current";
    EXPECT_EQ(measureCapture(capture).channels.size(), 2U);
    const auto one = measureCapture(capture, 1);
    ASSERT_EQ(one.channels.size(), 1U);
    EXPECT_EQ(one.channels[0].name, "current");
}

TEST(PulseMeasurement, ASlowRechargeOfEqualChargeBalances) {
    const auto m =
        measureChannel(recordOf({{1e-3, 200e-6, 40, 2e-6}, {1.3e-3, 2e-3, -4, 2e-6}}, {.noise = 0.05, .lsb = 0.05}), 0);
    ASSERT_EQ(m.measuredPulses, 1U);
    EXPECT_NEAR(m.pulses[0].leading.plateau, 40, 0.05);
    EXPECT_NEAR(m.pulses[0].second->plateau, -4, 0.05);
    EXPECT_NEAR(m.pulses[0].second->width_s, 2e-3, 2e-6);
    EXPECT_LT(m.pulses[0].imbalance, 0.01);
}

TEST(PulseMeasurement, ASquareWavesAmplitudeIsTopMinusBase) {
    std::vector<SyntheticPhase> phases;
    for (int k = 0; k < 9; ++k) phases.push_back({0.5e-3 + k * 1e-3, 0.5e-3, 3, 2e-6});
    const auto m = measureChannel(recordOf(phases, {.offset = -1, .noise = 0.01}), 0);
    EXPECT_EQ(m.states.count, StateCount::Two);
    EXPECT_EQ(m.measuredPulses, 9U);
    EXPECT_NEAR(m.amplitude.mean, 3, 0.005);
    EXPECT_NEAR(m.width_s.mean, 0.5e-3, 1e-7);
    EXPECT_NEAR(m.interval_s.mean, 1e-3, 1e-8);
    EXPECT_EQ(m.interval_s.n, 8U);
}

TEST(PulseMeasurement, MeasuresBothPhasesOfABiphasicPulse) {
    const auto m = measureChannel(recordOf(biphasic(2e-3, 30, 150e-6, 80e-6), {.offset = 0.7}), 0);
    EXPECT_EQ(m.states.count, StateCount::Three);
    ASSERT_EQ(m.measuredPulses, 1U);
    const auto& pulse = m.pulses[0];
    ASSERT_TRUE(pulse.second);
    EXPECT_NEAR(pulse.leading.plateau, 30, 1e-4);
    EXPECT_NEAR(pulse.second->plateau, -30, 1e-4);
    EXPECT_NEAR(pulse.gap_s, 80e-6, 1e-11);
    EXPECT_NEAR(pulse.second->width_s, 150e-6, 1e-11);
    EXPECT_NEAR(pulse.leading.charge, 30 * 150e-6, 1e-8);
    EXPECT_NEAR(pulse.second->charge, -30 * 150e-6, 1e-8);
    EXPECT_NEAR(pulse.imbalance, 0, 1e-5);
    EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
}

TEST(PulseMeasurement, PulsesOfDifferentHeightsInOneRecordAreEachMeasured) {
    auto phases = biphasic(1e-3, 10);
    append(phases, biphasic(3e-3, 40));
    append(phases, biphasic(5e-3, 20));
    const auto m = measureChannel(recordOf(phases, {.noise = 0.1}), 0);
    ASSERT_EQ(m.measuredPulses, 3U);
    EXPECT_NEAR(m.pulses[0].leading.plateau, 10, 0.05);
    EXPECT_NEAR(m.pulses[1].leading.plateau, 40, 0.05);
    EXPECT_NEAR(m.pulses[2].leading.plateau, 20, 0.05);
    EXPECT_NEAR(m.pulses[0].leading.width_s, 200e-6, 0.2e-6);
}

}  // namespace
}  // namespace tacto::test
