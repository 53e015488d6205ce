#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/electrode/PulseResponse.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

const Circuit kRcLoad = circuitAt(benchRcLoad(), 0);

PulseSegments biphasic(Drive drive, double level, double width, double gap, Drive inGap) {
    PulseSegments pulse;
    pulse.items[pulse.count++] = {drive, level, level, width};
    if (gap > 0) pulse.items[pulse.count++] = {inGap, 0, 0, gap};
    pulse.items[pulse.count++] = {drive, -level, -level, width};
    return pulse;
}

DriveSegment rest(Drive drive, double duration) { return {drive, 0, 0, duration}; }

/// The response to 40 V in the RC load, integrated numerically (tests/reference/loads.py).
double peakByScipy(const char* when) {
    return test::figuresOf("loads").at("bench_load_40_v").at(when).get<double>() / 1e3;
}

double peakDuring(const Circuit& circuit, const PulseSegments& pulse, std::size_t index) {
    PulseResponse response(circuit);
    double peak = 0;
    for (std::size_t s = 0; s <= index; ++s) {
        peak = 0;
        const auto added = response.add(pulse.items[s], PulsePart::LeadingPhase);
        for (const auto& piece : added.pieces()) {
            peak = std::max(peak, piece.peakCurrent());
        }
    }
    return peak;
}

TEST(PulseResponse, PeaksAtTheLeadingEdgeAndHigherAtReversalIntoTheRcLoad) {
    const auto withGap = biphasic(Drive::Voltage, 40, 200e-6, 100e-6, Drive::HighImpedance);
    const auto withoutGap = biphasic(Drive::Voltage, 40, 200e-6, 0, Drive::HighImpedance);
    const auto heldAtZero = biphasic(Drive::Voltage, 40, 200e-6, 100e-6, Drive::Voltage);
    EXPECT_NEAR(peakDuring(kRcLoad, withGap, 0), peakByScipy("leading_ma"), 1e-9);
    EXPECT_NEAR(peakDuring(kRcLoad, withGap, 2), peakByScipy("second_ma_high_impedance"), 1e-9);
    EXPECT_NEAR(peakDuring(kRcLoad, withoutGap, 1), peakByScipy("second_ma_no_gap"), 1e-9);
    EXPECT_NEAR(peakDuring(kRcLoad, heldAtZero, 2), peakByScipy("second_ma_zero"), 1e-9);
}

TEST(PulseResponse, FindsNetChargeOfAVoltageSourceThatLetsGoBetweenPhases) {
    RecordProperty("hazard", "H5");
    const auto pulse = biphasic(Drive::Voltage, 40, 200e-6, 100e-6, Drive::HighImpedance);
    const auto lettingGo = pulseTotals(kRcLoad, pulse, rest(Drive::HighImpedance, 0.5));
    EXPECT_NEAR(lettingGo.netCharge_C / lettingGo.leadingCharge_C,
                test::figuresOf("loads").at("bench_load_net_charge").get<double>(), 1e-9);
    EXPECT_NEAR(std::abs(lettingGo.endCapacitorVoltage), 0, 1e-12);
    EXPECT_GT(lettingGo.imbalance(), 0.3);
}

TEST(PulseResponse, FindsACurrentSourceBalanced) {
    RecordProperty("hazard", "H5");
    const auto pulse = biphasic(Drive::Current, 4e-3, 200e-6, 100e-6, Drive::HighImpedance);
    const auto totals = pulseTotals(kRcLoad, pulse, rest(Drive::HighImpedance, 0.5));
    EXPECT_NEAR(totals.imbalance(), 0, 1e-12);
    EXPECT_NEAR(totals.leadingCharge_C, 0.8e-6, 1e-15);
    EXPECT_NEAR(totals.secondCharge_C, -0.8e-6, 1e-15);
    EXPECT_NEAR(totals.impedanceOhm(),
                test::figuresOf("loads").at("bench_load_impedance_ohm").at("current").get<double>(), 1e-6);
}

TEST(PulseResponse, FindsACompliantCurrentSourceUnbalanced) {
    RecordProperty("hazard", "H5");
    const auto pulse = biphasic(Drive::Current, 10e-3, 200e-6, 100e-6, Drive::HighImpedance);
    const auto totals = pulseTotals(kRcLoad, pulse, rest(Drive::HighImpedance, 0.5), {20, 1});
    EXPECT_TRUE(totals.limited);
    EXPECT_GT(totals.imbalance(), 0.01);
    EXPECT_NEAR(totals.peakVoltage_V, 20, 1e-9);
}

TEST(PulseResponse, AgreesWithTheArithmeticOfAResistor) {
    const auto pulse = biphasic(Drive::Voltage, 40, 200e-6, 100e-6, Drive::Voltage);
    const auto totals = pulseTotals({500, 0, 0, false}, pulse, rest(Drive::Voltage, 0.5 - 500e-6));
    EXPECT_DOUBLE_EQ(totals.peakVoltage_V, 40);
    EXPECT_DOUBLE_EQ(totals.peakCurrent_A, 80e-3);
    EXPECT_NEAR(totals.leadingCharge_C, 16e-6, 1e-18);
    EXPECT_NEAR(totals.netCharge_C, 0, 1e-18);
    EXPECT_NEAR(totals.energy_J, 40 * 0.08 * 400e-6, 1e-15);
    // science.md section 7: 2.26 mA over 5 s.
    EXPECT_NEAR(std::sqrt(totals.currentSquared_A2s * 10 / 5), std::sqrt(10 * 0.08 * 0.08 * 400e-6 / 5), 1e-12);
    EXPECT_NEAR(std::sqrt(totals.currentSquared_A2s / 0.01), 16e-3, 1e-9) << "in-train";
}

TEST(PulseResponse, CarriesTheResidualVoltageToTheNextPulse) {
    const auto pulse = biphasic(Drive::Voltage, 40, 200e-6, 0, Drive::Voltage);
    PulseResponse response(kRcLoad);
    response.addPulse(pulse, rest(Drive::HighImpedance, 0.2e-3));
    const double residual = response.capacitorVoltage();
    EXPECT_LT(residual, -10);
    EXPECT_NEAR(response.totals().peakCurrent_A, peakByScipy("second_ma_no_gap"), 1e-9);
    response.restart();
    EXPECT_EQ(response.totals().peakCurrent_A, 0);
    EXPECT_EQ(response.capacitorVoltage(), residual);
    PulseResponse second(kRcLoad, {}, residual);
    EXPECT_NEAR(second.add(pulse.items[0], PulsePart::LeadingPhase).current(0), (40 - residual) / 200, 1e-12);
}

TEST(PulseResponse, TotalsOfTwoPulsesAreTheSumOfTheParts) {
    const auto pulse = biphasic(Drive::Voltage, 20, 200e-6, 100e-6, Drive::HighImpedance);
    PulseResponse both(kRcLoad);
    both.addPulse(pulse, rest(Drive::HighImpedance, 1e-3));
    const auto first = both.totals();
    both.addPulse(pulse, rest(Drive::HighImpedance, 1e-3));
    PulseResponse alone(kRcLoad, {}, first.endCapacitorVoltage);
    alone.addPulse(pulse, rest(Drive::HighImpedance, 1e-3));
    EXPECT_NEAR(both.totals().energy_J, first.energy_J + alone.totals().energy_J, 1e-15);
    EXPECT_NEAR(both.totals().netCharge_C, first.netCharge_C + alone.totals().netCharge_C, 1e-15);
    EXPECT_EQ(both.capacitorVoltage(), alone.capacitorVoltage());
}

TEST(PulseResponse, GainsNoEnergyFromAPassiveLoad) {
    for (const double level : {1.0, 20.0, 40.0}) {
        const auto pulse = biphasic(Drive::Voltage, level, 200e-6, 100e-6, Drive::HighImpedance);
        const auto totals = pulseTotals(kRcLoad, pulse, rest(Drive::Voltage, 0.1));
        // All of it ends in the two resistors; what the series one takes is a lower bound.
        EXPECT_GT(totals.energy_J, totals.currentSquared_A2s * 200);
    }
}

}  // namespace
}  // namespace tacto
