// What 128 magnitudes say about the electrodes, and what they cannot show.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/electrode/Load.h"
#include "drivers/sciencemode/ReadBack.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sciencemode/EmulatedOutput.h"

namespace tacto::test {
namespace {

using namespace sciencemode;

PulsePlan planOf(double mA, double width_us = 200) {
    PulseTrain train;
    train.amplitude = Milliamps(mA);
    train.phaseWidth = Micros(width_us);
    return *planPulse(train);
}

/// Returns the ack that follows from physics.
ChannelConfigAck ackOf(const PulsePlan& plan, const Load& load, Measurement measurement, bool total = false) {
    ChannelConfigAck ack;
    ack.complete = true;
    ack.measurement = measurement;
    EmulatedOutput output(load, Volts(150));
    const auto& pulse = output.play(plan.points, 0, false, Instant(0), &ack, total);
    if (output.isOpen(pulse.onset)) ack.result = ResultCode::Electrode;
    return ack;
}

PulseReading reading(double mA, const Load& load, Measurement measurement = Measurement::Voltage, double width_us = 200,
                     bool total = false) {
    const auto plan = planOf(mA, width_us);
    return readPulse(ackOf(plan, load, measurement, total), plan, Volts(150));
}

TEST(ScienceModeReadBack, ImpedanceIsThatAtTheEndOfTheLeadingPhase) {
    for (const double width : {50.0, 200.0, 333.0, 1000.0, 4095.0}) {
        for (const auto& [name, load] : benchLoads()) {
            if (load.kind == LoadKind::Open || load.kind == LoadKind::Short) continue;
            const double mA = (load.series + load.parallel).value() > 20e3 ? 0.5 : 4;
            const DriveSegment leading{Drive::Current, mA * 1e-3, mA * 1e-3, width * 1e-6};
            const double wanted = effectiveImpedance(load, leading).value();
            const auto read = reading(mA, load, Measurement::Voltage, width);
            EXPECT_EQ(read.electrode, ElectrodeState::Ok) << name;
            ASSERT_TRUE(read.impedance.has_value()) << name;
            // Tolerance: 0.5 % of the magnitude, plus the last digit of 0.01 V.
            EXPECT_NEAR(read.impedance->value(), wanted, 0.005 * wanted + 0.011 / (mA * 1e-3)) << name << ", " << width;
            EXPECT_FALSE(read.amplitude.has_value()) << "the current was not measured";
            EXPECT_FALSE(read.imbalance.has_value());
        }
    }
}

double benchRcByScipy() { return figuresOf("loads").at("bench_load_impedance_ohm").at("current"); }

TEST(ScienceModeReadBack, TheBenchRcLoadReads3500OhmFromACurrentSource) {
    EXPECT_NEAR(reading(5, benchRcLoad()).impedance->value(), benchRcByScipy(), 20);
}

TEST(ScienceModeReadBack, ASampleTimeThatCountsAllSamplesReadsTheSame) {
    EXPECT_NEAR(reading(5, benchRcLoad(), Measurement::Voltage, 200, true).impedance->value(), benchRcByScipy(), 20);
}

TEST(ScienceModeReadBack, OpenAndShortAreTold) {
    RecordProperty("hazard", "H3");
    EXPECT_EQ(reading(5, Load::openCircuit()).electrode, ElectrodeState::Open);
    EXPECT_FALSE(reading(5, Load::openCircuit()).impedance.has_value());
    EXPECT_EQ(reading(5, Load::openCircuit(), Measurement::Current).electrode, ElectrodeState::Open);
    EXPECT_EQ(reading(5, Load::shortCircuit()).electrode, ElectrodeState::Short);
    EXPECT_EQ(reading(0.5, Load::shortCircuit()).electrode, ElectrodeState::Short);
    EXPECT_EQ(reading(0.5, Load::resistor(Ohms(100))).electrode, ElectrodeState::Ok);
}

TEST(ScienceModeReadBack, AnOpenElectrodeIsSeenEvenIfTheDeviceCallsItFine) {
    RecordProperty("hazard", "H3");
    const auto plan = planOf(5);
    for (const auto measurement : {Measurement::Voltage, Measurement::Current}) {
        auto ack = ackOf(plan, Load::openCircuit(), measurement);
        ack.result = ResultCode::Ok;
        EXPECT_EQ(readPulse(ack, plan, Volts(150)).electrode, ElectrodeState::Open);
    }
}

TEST(ScienceModeReadBack, TheSamplesAreKeptAsMagnitudesInTheirUnit) {
    const auto volts = reading(5, Load::resistor(Ohms(1000)));
    ASSERT_TRUE(volts.samples.has_value());
    EXPECT_EQ(volts.samples->measurement, Measurement::Voltage);
    EXPECT_EQ(volts.samples->step, Micros(4));
    EXPECT_FLOAT_EQ(volts.samples->magnitudes[0], 5);
    EXPECT_FLOAT_EQ(volts.samples->magnitudes[60], 0) << "the gap";
    EXPECT_FLOAT_EQ(volts.samples->magnitudes[80], 5) << "the second phase: the sign is lost";
    EXPECT_EQ(reading(5, Load::resistor(Ohms(1000)), Measurement::Voltage, 200, true).samples->step, Micros(4));
    const auto current = reading(5, Load::resistor(Ohms(1000)), Measurement::Current);
    ASSERT_TRUE(current.samples.has_value());
    EXPECT_EQ(current.samples->measurement, Measurement::Current);
    EXPECT_FLOAT_EQ(current.samples->magnitudes[0], 5);
    EXPECT_FALSE(reading(5, Load::resistor(Ohms(1000)), Measurement::None).samples.has_value());
    EXPECT_TRUE(reading(5, Load::openCircuit()).samples.has_value()) << "what an open electrode looks like";
}

TEST(ScienceModeReadBack, CurrentGivesTheAmplitudeAndNoImpedance) {
    const auto read = reading(5, Load::resistor(Ohms(1000)), Measurement::Current);
    EXPECT_EQ(read.electrode, ElectrodeState::Ok);
    ASSERT_TRUE(read.amplitude.has_value());
    EXPECT_NEAR(read.amplitude->value(), 5, 0.01);
    EXPECT_FALSE(read.impedance.has_value());
}

TEST(ScienceModeReadBack, MagnitudesNeverProveBalanceButDoProveItsAbsence) {
    RecordProperty("hazard", "H5");
    const auto plan = planOf(10, 1000);
    auto ack = ackOf(plan, Load::resistor(Ohms(1000)), Measurement::Current);
    EXPECT_FALSE(readPulse(ack, plan, Volts(150)).imbalance.has_value()) << "two equal magnitudes may have one sign";
    // Makes the second phase 10 % weaker.
    const double step = sampleStep(ack, plan)->count();
    for (std::size_t i = 0; i < kSamples; ++i) {
        if (static_cast<double>(i) * step >= 1100) ack.samples[i] = static_cast<std::uint16_t>(ack.samples[i] * 9 / 10);
    }
    const auto weaker = readPulse(ack, plan, Volts(150));
    ASSERT_TRUE(weaker.imbalance && weaker.imbalanceUncertainty);
    EXPECT_NEAR(*weaker.imbalance, 0.1, *weaker.imbalanceUncertainty);
    EXPECT_LT(*weaker.imbalanceUncertainty, 0.05);
}

TEST(ScienceModeReadBack, WithoutSamplesNothingIsClaimed) {
    RecordProperty("hazard", "H9");
    const auto plan = planOf(5);
    ChannelConfigAck ack;
    ack.complete = true;
    auto read = readPulse(ack, plan, Volts(150));
    EXPECT_EQ(read.electrode, ElectrodeState::NotMeasured);
    EXPECT_FALSE(read.impedance || read.amplitude || read.imbalance);
    ack.measured = true;
    ack.measurement = Measurement::Voltage;
    read = readPulse(ack, plan, Volts(150));
    EXPECT_EQ(read.electrode, ElectrodeState::NotMeasured) << "a sample time of 0 places no sample";
    ack.sampleTime_us = 1;  // 128 samples of 1 µs end within the leading phase
    read = readPulse(ack, plan, Volts(150));
    EXPECT_EQ(read.electrode, ElectrodeState::NotMeasured);
    EXPECT_FALSE(read.impedance.has_value());
}

TEST(ScienceModePlan, RefusesVolts) {
    RecordProperty("hazard", "H4");
    PulseTrain train;
    train.amplitude = Volts(5);
    EXPECT_THAT(planPulse(train), refused(ErrorCode::Device));
}

TEST(ScienceModePlan, RefusesRatherThanRounds) {
    RecordProperty("hazard", "H1");
    const auto refused = [](auto change) {
        PulseTrain train;
        train.amplitude = Milliamps(5);
        train.rate = Hertz(20);
        change(train);
        return !planPulse(train).has_value();
    };
    EXPECT_FALSE(refused([](PulseTrain&) {}));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.amplitude = Milliamps(5.2); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.amplitude = Milliamps(130.5); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.amplitude = Milliamps(std::nan("")); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.phaseWidth = Micros(200.5); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.phaseWidth = Micros(9); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.phaseWidth = Micros(4096); }));
    EXPECT_TRUE(refused([](PulseTrain& t) { t.interPhaseGap = Micros(5); }));
    EXPECT_FALSE(refused([](PulseTrain& t) { t.interPhaseGap = Micros(0); }));
    const auto asymmetric = [](PulseTrain& t) { t.shape = PulseShape::AsymmetricBiphasic; };
    EXPECT_FALSE(refused([&](PulseTrain& t) { asymmetric(t); }));
    EXPECT_TRUE(refused([&](PulseTrain& t) { asymmetric(t), t.amplitude = Milliamps(4); })) << "0.4 mA is off the grid";
    EXPECT_TRUE(refused([&](PulseTrain& t) {
        asymmetric(t);
        t.phaseWidth = Micros(4000);
        t.rechargeRatio = 20;
        t.amplitude = Milliamps(10);
        t.rate = Hertz(5);
    })) << "80 ms are more than 16 points";
}

TEST(ScienceModePlan, ChargeOfEveryPlannedPulseIsBalanced) {
    RecordProperty("hazard", "H5");
    for (const auto shape : {PulseShape::SymmetricBiphasic, PulseShape::AsymmetricBiphasic}) {
        for (const auto polarity : {Polarity::Positive, Polarity::Negative}) {
            PulseTrain train;
            train.amplitude = Milliamps(20);
            train.shape = shape;
            train.polarity = polarity;
            train.phaseWidth = Micros(1111);
            train.rate = Hertz(20);
            const auto plan = accepted(planPulse(train));
            double charge = 0;
            for (const auto& point : plan.points.span()) charge += point.current.value() * point.time.count();
            EXPECT_EQ(charge, 0);
            EXPECT_EQ(plan.points.items[0].current.value(), polarity == Polarity::Positive ? 20 : -20);
            EXPECT_NEAR(plan.points.duration().count(), train.pulseDuration().count() * 1e6, 1e-6);
        }
    }
}

}  // namespace
}  // namespace tacto::test
