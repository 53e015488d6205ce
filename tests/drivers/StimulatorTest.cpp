#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/drivers/SimBench.h"
#include "tests/drivers/conformance/StimulatorConformance.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

constexpr const char* kRcLoad = "200 ohm + 10 kohm || 50 nF";

ScopeSettings fastRecord(double triggerLevel = 5) {
    ScopeSettings settings;
    settings.sampleRate = Hertz(10e6);
    settings.samples = 20'000;
    settings.currentRange = Milliamps(500);
    settings.triggerLevel = triggerLevel;
    return settings;
}

/// Returns the peak current in mA that the oscilloscope sees for a pulse of 40 V.
double peakIntoRc(const std::string& parameters, double gap_us, bool secondPhase) {
    SimBench bench(kRcLoad);
    bench.open("sim:oscilloscope?noise=0");
    bench.open("sim:stimulator?rise=20ns" + parameters);
    bench.arm(fastRecord());
    bench.deliver(voltagePulse(40, gap_us));
    const auto capture = bench.capture();
    const auto onset = static_cast<std::size_t>((capture.trigger_s - capture.start_s) * capture.rate_hz);
    const auto phase = static_cast<std::size_t>((200 + gap_us / 2) * 1e-6 * capture.rate_hz);
    double peak = 0;
    for (std::size_t i = 0; i < capture.samples(); ++i) {
        const double amps = std::abs(static_cast<double>(capture.channels[1].samples[i]));
        if ((i > onset + phase) == secondPhase) peak = std::max(peak, amps);
    }
    return peak * 1e3;
}

TEST(SimulatedStimulator, PeakCurrentsIntoTheRcLoadAreThoseOfItsEquations) {
    // Values from tests/reference/loads.py; 20 ns edges and 10 MS/s explain the few tenths of a percent of tolerance.
    const auto& scipy = figuresOf("loads").at("bench_load_40_v");
    EXPECT_NEAR(peakIntoRc("&gap=highz", 100, false), scipy.at("leading_ma").get<double>(), 2);
    EXPECT_NEAR(peakIntoRc("&gap=highz", 100, true), scipy.at("second_ma_high_impedance").get<double>(), 3.6);
    EXPECT_NEAR(peakIntoRc("", 0, true), scipy.at("second_ma_no_gap").get<double>(), 4);
    EXPECT_NEAR(peakIntoRc("&gap=zero", 100, true), scipy.at("second_ma_zero").get<double>(), 3)
        << "a gap held at 0 V discharges the skin";
}

TEST(SimulatedStimulator, ImpedanceReadingsDifferByKindOfSourceAsTheDefinitionSays) {
    const auto& scipy = figuresOf("loads").at("bench_load_impedance_ohm");
    SimBench voltage(kRcLoad);
    voltage.open("sim:stimulator?readbacknoise=0");
    voltage.deliver(voltagePulse(40));
    EXPECT_NEAR(voltage.devices.stimulator->status()->impedance->value(), scipy.at("voltage").get<double>(), 20);
    SimBench current(kRcLoad);
    current.open("sim:stimulator?mode=current&readbacknoise=0");
    current.deliver(currentPulse(2));
    EXPECT_NEAR(current.devices.stimulator->status()->impedance->value(), scipy.at("current").get<double>(), 10);
}

TEST(SimulatedStimulator, GainOffsetAndStepsShowInThePlateau) {
    SimBench bench;
    bench.open("sim:oscilloscope?noise=0&bits=16");
    bench.open("sim:stimulator?gain=1.02&offset=0.3&step=0.25");
    for (const double asked : {5.0, 20.0, 35.0}) {
        bench.arm(fastRecord(2));
        bench.deliver(voltagePulse(asked));
        const auto capture = bench.capture();
        EXPECT_NEAR(peakOf(capture.channels[0]), 1.02 * asked + 0.3, 0.01) << asked;
        EXPECT_NEAR(peakOf(capture.channels[1]), (1.02 * asked + 0.3) / 1000, 1e-4) << asked;
    }
}

TEST(SimulatedStimulator, WidthAtHalfAndChargeSurviveASlowEdge) {
    SimBench bench;
    bench.open("sim:stimulator?rise=20us");
    bench.deliver(voltagePulse(20));
    const auto pulse = accepted(bench.circuit().lastPulse(bench.clock.now()));
    EXPECT_NEAR(pulse.netCharge_C, 0, 1e-12);
    // The ramp up belongs to the leading phase, the ramp down to the gap: half an edge less than 20 V · 200 µs / 1 kΩ.
    EXPECT_NEAR(pulse.leadingCharge_C, 20e-3 * 190e-6, 1e-10);
    EXPECT_NEAR(pulse.energy_J, 2 * 0.4 * (200e-6 - 20e-6 / 3), 1e-7);
}

TEST(SimulatedStimulator, ComplianceCapsACurrentSource) {
    SimBench bench("10 kohm");
    bench.open("sim:oscilloscope?noise=0");
    bench.open("sim:stimulator?mode=current&compliance=60V&limit=50mA");
    ScopeSettings settings = fastRecord();
    settings.voltageRange = Volts(100);
    bench.arm(settings);
    bench.deliver(currentPulse(20));
    const auto capture = bench.capture();
    EXPECT_NEAR(peakOf(capture.channels[0]), 60, 0.2);
    EXPECT_NEAR(peakOf(capture.channels[1]), 6e-3, 4e-4);
}

TEST(SimulatedStimulator, CurrentLimitCapsAVoltageSourceIntoAShort) {
    SimBench bench("1 kohm");
    bench.open("sim:stimulator?load=short&limit=0.5A");
    bench.deliver(voltagePulse(40));
    EXPECT_NEAR(bench.circuit().lastPulse(bench.clock.now())->peakCurrent_A, 0.5, 1e-6);
    EXPECT_EQ(bench.devices.stimulator->status()->electrode, ElectrodeState::Short);
}

TEST(SimulatedStimulator, ImbalanceIsReadBackWithItsUncertainty) {
    RecordProperty("hazard", "H5");
    SimBench bench;
    bench.open("sim:stimulator?imbalance=0.05");
    bench.deliver(voltagePulse(20));
    const auto status = bench.devices.stimulator->status();
    ASSERT_TRUE(status->imbalance && status->imbalanceUncertainty);
    EXPECT_NEAR(*status->imbalance, 0.05, *status->imbalanceUncertainty);
}

TEST(SimulatedStimulator, OnsetsJitterAsStated) {
    SimBench bench;
    bench.open("sim:stimulator?latency=1ms&jitter=50us");
    double sum = 0, square = 0;
    constexpr int kTrains = 200;
    for (int i = 0; i < kTrains; ++i) {
        const double asked = toSeconds(bench.clock.now());
        bench.deliver(voltagePulse(5));
        const double onset = bench.circuit().inspect(bench.clock.now(), [](const auto& p) { return p.back().onset_s; });
        sum += onset - asked;
        square += (onset - asked) * (onset - asked);
    }
    const double mean = sum / kTrains;
    EXPECT_NEAR(mean, 1e-3, 15e-6);
    EXPECT_NEAR(std::sqrt(square / kTrains - mean * mean), 50e-6, 10e-6);
}

TEST(SimulatedStimulator, RefusesATrainWhileOneIsInProgress) {
    SimBench bench;
    bench.open("sim:stimulator");
    auto train = voltagePulse(5);
    train.pulses = 20;
    bench.deliver(train, Seconds(0.05));
    EXPECT_THAT(bench.devices.stimulator->deliver(bench.approved(voltagePulse(5))), refused(ErrorCode::Device));
}

TEST(SimulatedStimulator, ResidualVoltageCarriesFromPulseToPulse) {
    SimBench bench(kRcLoad);
    bench.open("sim:stimulator?gap=highz");
    auto train = voltagePulse(20, 0);
    train.shape = PulseShape::Monophasic;
    train.pulses = 3;
    train.rate = Hertz(2000);
    bench.deliver(train);
    bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) {
        ASSERT_EQ(pulses.size(), 3U);
        // The first pulse starts from an empty capacitor: 20 V / 200 ohm. The others meet the remaining charge.
        EXPECT_NEAR(pulses[0].totals.peakCurrent_A, 0.1, 1e-3);
        EXPECT_LT(pulses[1].totals.peakCurrent_A, 0.06);
        EXPECT_GT(pulses[1].totals.peakCurrent_A, 0.02);
    });
}

TEST(SimulatedStimulator, WhatIsPlayedDoesNotDependOnWhoLooks) {
    const auto run = [](bool look) {
        SimBench bench(kRcLoad);
        bench.open("sim:stimulator?gap=highz");
        auto train = voltagePulse(20);
        train.pulses = 10;
        EXPECT_TRUE(bench.devices.stimulator->deliver(bench.approved(train)).has_value());
        for (int i = 0; i < 521; ++i) {
            bench.wait(Seconds(1e-4));
            if (look) static_cast<void>(bench.circuit().active(bench.clock.now()));
        }
        bench.devices.stimulator->forceOff();
        bench.wait(Seconds(0.1));
        return bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) {
            std::vector<double> out;
            for (const auto& pulse : pulses) {
                out.insert(out.end(), {pulse.onset_s, pulse.end_s, pulse.totals.netCharge_C, pulse.totals.energy_J});
            }
            return out;
        });
    };
    EXPECT_EQ(run(true), run(false));
}

TEST(SimulatedStimulator, ForceOffTruncatesThePulseInProgress) {
    RecordProperty("hazard", "H2");
    SimBench bench;
    bench.open("sim:stimulator?latency=0&jitter=0");
    auto train = voltagePulse(20);
    train.pulses = 5;
    ASSERT_TRUE(bench.devices.stimulator->deliver(bench.approved(train)).has_value());
    bench.wait(Seconds(10e-3 + 100e-6));  // the middle of the second pulse's leading phase
    bench.devices.stimulator->forceOff();
    bench.wait(Seconds(1));
    bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) {
        ASSERT_EQ(pulses.size(), 2U);
        EXPECT_TRUE(pulses[1].cut);
        EXPECT_NEAR(pulses[1].end_s - pulses[1].onset_s, 100e-6, 1e-8);
        EXPECT_NEAR(pulses[1].totals.netCharge_C, 20e-3 * 100e-6, 1e-8);
    });
}

TEST(SimulatedStimulator, DeadManEndsATrainThatIsNotKeptAlive) {
    RecordProperty("hazard", "H2");
    for (const bool kept : {false, true}) {
        SimBench bench;
        bench.open("sim:stimulator?deadman=2s");
        auto train = voltagePulse(5);
        train.pulses = 600;  // a train of 6 s
        ASSERT_TRUE(bench.devices.stimulator->deliver(bench.approved(train)).has_value());
        for (int i = 0; i < 50; ++i) {
            bench.wait(Seconds(0.1));
            if (kept) {
                EXPECT_TRUE(bench.devices.stimulator->keepAlive().has_value());
            }
        }
        const double last =
            bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) { return pulses.back().onset_s; });
        if (kept) {
            EXPECT_GT(last, 4.9);
        } else {
            EXPECT_LE(last, 2.0);
            EXPECT_GT(last, 1.9);
        }
        EXPECT_EQ(bench.circuit().active(bench.clock.now()), kept);
    }
}

TEST(SimulatedStimulator, DeliversUntilTheHeartbeatStopsAndStaysOff) {
    RecordProperty("hazard", "H2");
    SimBench bench;
    bench.open("sim:stimulator");
    auto train = voltagePulse(5);
    train.pulses = 1000;
    train.rate = Hertz(50);  // a train of 20 s
    ASSERT_TRUE(bench.devices.stimulator->deliver(bench.approved(train)).has_value());
    for (int i = 0; i < 100; ++i) {
        bench.wait(Seconds(0.1));
        ASSERT_TRUE(bench.devices.stimulator->keepAlive().has_value());
    }
    EXPECT_TRUE(bench.circuit().active(bench.clock.now()));
    bench.wait(Seconds(5));
    EXPECT_FALSE(bench.circuit().active(bench.clock.now()));
    const auto number = [&] {
        return bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) { return pulses.back().number; });
    };
    EXPECT_EQ(number(), 600U);
    EXPECT_TRUE(bench.devices.stimulator->keepAlive().has_value());
    bench.wait(Seconds(1));
    EXPECT_FALSE(bench.circuit().active(bench.clock.now())) << "a late heartbeat must not revive the output";
    EXPECT_EQ(number(), 600U);
}

// --- faults ---------------------------------------------------------------------------------------------------------

TEST(StimulatorFaults, OpenAndShortComeAtTheirTimeAndAreReadBack) {
    RecordProperty("hazard", "H3");
    for (const auto& [name, state] : {std::pair{"open", ElectrodeState::Open}, {"short", ElectrodeState::Short}}) {
        for (const auto* mode : {"voltage", "current"}) {
            SimBench bench;
            bench.open(fmt::format("sim:stimulator?mode={}&fault={}@1s..2s", mode, name));
            const auto pulse = std::string_view(mode) == "current" ? currentPulse(5) : voltagePulse(5);
            bench.deliver(pulse);
            EXPECT_EQ(bench.devices.stimulator->status()->electrode, ElectrodeState::Ok) << name << mode;
            bench.wait(Seconds(1));
            bench.deliver(pulse);
            EXPECT_EQ(bench.devices.stimulator->status()->electrode, state) << name << mode;
            bench.wait(Seconds(1));
            bench.deliver(pulse);
            EXPECT_EQ(bench.devices.stimulator->status()->electrode, ElectrodeState::Ok) << name << mode;
        }
    }
}

TEST(StimulatorFaults, StuckOnGoesOnPastItsTrainUntilSwitchedOff) {
    RecordProperty("hazard", "H2");
    SimBench bench;
    bench.open("sim:stimulator?fault=stuck-on");
    bench.deliver(voltagePulse(5), Seconds(0.5));
    EXPECT_TRUE(bench.devices.stimulator->status()->delivering);
    bench.devices.stimulator->forceOff();
    bench.wait(Seconds(0.01));
    EXPECT_FALSE(bench.devices.stimulator->status()->delivering);
}

TEST(StimulatorFaults, StuckOnStillEndsByTheDeadMan) {
    RecordProperty("hazard", "H2");
    SimBench bench;
    bench.open("sim:stimulator?fault=stuck-on");
    bench.deliver(voltagePulse(5), Seconds(2.1));
    EXPECT_FALSE(bench.devices.stimulator->status()->delivering);
}

TEST(StimulatorFaults, DriftRaisesTheOutput) {
    SimBench bench;
    bench.open("sim:stimulator?fault=drift@1s");
    bench.wait(Seconds(6));
    bench.deliver(voltagePulse(10));
    EXPECT_NEAR(bench.circuit().lastPulse(bench.clock.now())->peakVoltage_V, 11, 0.01);
}

TEST(StimulatorFaults, RepliesGoWrongEachInItsWay) {
    SimBench garbage;
    garbage.open("sim:stimulator?fault=garbage");
    EXPECT_EQ(garbage.devices.stimulator->status().error().code, ErrorCode::Device);
    EXPECT_THAT(garbage.devices.stimulator->deliver(garbage.approved(voltagePulse(5))).error().message,
                testing::HasSubstr("garbage"));
    garbage.wait(Seconds(0.05));
    EXPECT_EQ(garbage.circuit().trainsBegun(garbage.clock.now()), 1U)
        << "the command went out, only its answer is lost";

    SimBench nan;
    nan.open("sim:stimulator?fault=nan");
    nan.deliver(voltagePulse(5));
    EXPECT_TRUE(std::isnan(nan.devices.stimulator->status()->impedance->value()));
    EXPECT_TRUE(std::isnan(*nan.devices.stimulator->status()->imbalance));
}

TEST(StimulatorFaults, ALateTrainIsSuppressedByForceOffAfterTheTimeout) {
    RecordProperty("hazard", "H2");
    for (const bool off : {false, true}) {
        SimBench bench;
        bench.open("sim:stimulator?fault=late");
        EXPECT_THAT(bench.devices.stimulator->deliver(bench.approved(voltagePulse(5))), refused(ErrorCode::Timeout));
        if (off) bench.devices.stimulator->forceOff();
        bench.wait(Seconds(0.2));
        EXPECT_EQ(bench.circuit().trainsBegun(bench.clock.now()), off ? 0U : 1U);
    }
}

}  // namespace
}  // namespace tacto::test
