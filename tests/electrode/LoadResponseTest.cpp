#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "core/electrode/LoadResponse.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

/// Computes the values of a SegmentResponse the slow way: fourth-order Runge-Kutta for the capacitor's voltage, with
/// the source's limits applied at every step and the integrals summed up alongside.
struct Oracle {
    Circuit z;
    DriveSegment drive;
    SourceLimits limits;

    struct Point {
        double v = 0;
        double i = 0;
    };
    [[nodiscard]] Point at(double t, double capacitor) const {
        const double level = drive.start + (drive.end - drive.start) * t / drive.duration_s;
        Point p;
        if (drive.drive == Drive::HighImpedance) {
            p.v = capacitor;
        } else if (drive.drive == Drive::Voltage) {
            p.v = std::clamp(level, -limits.compliance_V, limits.compliance_V);
            p.i = (p.v - capacitor) / z.seriesOhm;
            if (std::abs(p.i) > limits.current_A) {
                p.i = std::copysign(limits.current_A, p.i);
                p.v = p.i * z.seriesOhm + capacitor;
            }
        } else {
            p.i = std::clamp(level, -limits.current_A, limits.current_A);
            p.v = p.i * z.seriesOhm + capacitor;
            if (std::abs(p.v) > limits.compliance_V) {
                p.v = std::copysign(limits.compliance_V, p.v);
                p.i = (p.v - capacitor) / z.seriesOhm;
            }
        }
        return p;
    }

    double charge = 0, squared = 0, energy = 0, vc = 0, peakV = 0, peakI = 0;
    void run(double vc0, const SegmentResponse& claimed, int steps = 20'000) {
        vc = vc0;
        const double h = drive.duration_s / steps;
        const auto slope = [&](double t, double x) {
            return z.hasCapacitor() ? (at(t, x).i - x / z.parallelOhm) / z.capacitance_F : 0.0;
        };
        // Values are compared by their mean error: at a corner the two methods may differ for one step.
        double meanError = 0;
        for (int n = 0; n < steps; ++n) {
            const double t = n * h;
            const double k1 = slope(t, vc);
            const double k2 = slope(t + h / 2, vc + h / 2 * k1);
            const double k3 = slope(t + h / 2, vc + h / 2 * k2);
            const double k4 = slope(t + h, vc + h * k3);
            const double middle = vc + h / 2 * k2;
            const double next = vc + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
            const Point a = at(t, vc);
            const Point b = at(t + h / 2, middle);
            const Point c = at(t + h, next);
            charge += h / 6 * (a.i + 4 * b.i + c.i);
            squared += h / 6 * (a.i * a.i + 4 * b.i * b.i + c.i * c.i);
            energy += h / 6 * (a.v * a.i + 4 * b.v * b.i + c.v * c.i);
            peakV = std::max({peakV, std::abs(a.v), std::abs(c.v)});
            peakI = std::max({peakI, std::abs(a.i), std::abs(c.i)});
            meanError += std::abs(claimed.voltage(t + h / 2) - b.v) / steps / (std::abs(peakV) + 1e-9);
            vc = next;
        }
        EXPECT_LT(meanError, 1e-4);
    }
};

void expectMatchesOracle(const Circuit& z, const DriveSegment& drive, double vc0, const SourceLimits& limits) {
    const auto claimed = respond(z, drive, vc0, limits);
    Oracle oracle{z, drive, limits};
    oracle.run(vc0, claimed);
    double charge = 0, squared = 0, energy = 0, peakV = 0, peakI = 0, duration = 0;
    for (const auto& piece : claimed.pieces()) {
        EXPECT_NEAR(piece.start_s, duration, 1e-9 * drive.duration_s);
        duration += piece.duration_s;
        charge += piece.charge();
        squared += piece.currentSquared();
        energy += piece.energy();
        peakV = std::max(peakV, piece.peakVoltage());
        peakI = std::max(peakI, piece.peakCurrent());
    }
    const double T = drive.duration_s;
    EXPECT_NEAR(duration, T, 1e-12 * T);
    EXPECT_NEAR(claimed.endCapacitorVoltage, oracle.vc, 1e-4 * (peakV + 1e-9));
    EXPECT_NEAR(charge, oracle.charge, 1e-4 * peakI * T + 1e-15);
    EXPECT_NEAR(squared, oracle.squared, 2e-4 * peakI * peakI * T + 1e-18);
    EXPECT_NEAR(energy, oracle.energy, 2e-4 * peakV * peakI * T + 1e-15);
    EXPECT_NEAR(peakV, oracle.peakV, 1e-3 * oracle.peakV + 1e-12);
    EXPECT_NEAR(peakI, oracle.peakI, 1e-3 * oracle.peakI + 1e-12);
}

const Circuit kRc = circuitAt(benchRcLoad(), 0);

TEST(Respond, MatchesFineIntegrationForPlateausAndRamps) {
    for (const Circuit& z : {kRc, Circuit{500, 0, 0, false}}) {
        for (const double vc0 : {0.0, 25.0, -10.0}) {
            const double start = z.hasCapacitor() ? vc0 : 0;
            expectMatchesOracle(z, {Drive::Voltage, 40, 40, 200e-6}, start, {});
            expectMatchesOracle(z, {Drive::Voltage, 0, 40, 5e-6}, start, {});
            expectMatchesOracle(z, {Drive::Voltage, 40, -40, 100e-6}, start, {});
            expectMatchesOracle(z, {Drive::Current, -8e-3, -8e-3, 200e-6}, start, {});
            expectMatchesOracle(z, {Drive::Current, -8e-3, 8e-3, 300e-6}, start, {});
            expectMatchesOracle(z, {Drive::HighImpedance, 0, 0, 100e-6}, start, {});
        }
    }
}

TEST(Respond, MatchesFineIntegrationWhereLimitsAreReached) {
    const SourceLimits compliance{20, 1};
    expectMatchesOracle(kRc, {Drive::Current, 10e-3, 10e-3, 400e-6}, 0, compliance);
    expectMatchesOracle(kRc, {Drive::Current, -10e-3, -10e-3, 400e-6}, 15, compliance);
    expectMatchesOracle(kRc, {Drive::Current, 10e-3, -10e-3, 400e-6}, 10, compliance);  // a ramp from + to -
    expectMatchesOracle(kRc, {Drive::Current, 0, 20e-3, 400e-6}, 0, compliance);
    const SourceLimits current{50, 30e-3};
    expectMatchesOracle(kRc, {Drive::Voltage, 40, 40, 200e-6}, 0, current);  // would need 200 mA
    expectMatchesOracle(kRc, {Drive::Voltage, -40, -40, 200e-6}, 39, current);
    expectMatchesOracle(kRc, {Drive::Voltage, 40, -40, 400e-6}, 0, current);
    expectMatchesOracle(kRc, {Drive::Voltage, 0, 80, 200e-6}, 0, current);  // the current exceeds its limit
    expectMatchesOracle({100, 0, 0, false}, {Drive::Voltage, -20, 20, 1e-3}, 0, current);
}

RC_GTEST_PROP(Respond, MatchesFineIntegrationForAnySourceAndLoad, ()) {
    const auto between = [](double low, double high) {
        return low + (high - low) * (*rc::gen::inRange(0, 10'001)) / 10'000.0;
    };
    const auto logBetween = [&](double low, double high) { return low * std::pow(high / low, between(0, 1)); };
    Circuit z{logBetween(50, 5e3), 0, 0, false};
    if (*rc::gen::inRange(0, 4) > 0) {
        z.parallelOhm = logBetween(500, 100e3);
        z.capacitance_F = logBetween(5e-9, 200e-9);
    }
    DriveSegment drive;
    drive.drive = *rc::gen::element(Drive::Voltage, Drive::Current, Drive::HighImpedance);
    const double scale = drive.drive == Drive::Voltage ? 60 : 40e-3;
    drive.start = between(-scale, scale);
    drive.end = *rc::gen::arbitrary<bool>() ? drive.start : between(-scale, scale);
    SourceLimits limits;
    if (*rc::gen::arbitrary<bool>()) limits.compliance_V = between(5, 60);
    if (*rc::gen::arbitrary<bool>()) limits.current_A = between(2e-3, 100e-3);
    const double range = std::min(limits.compliance_V, 40.0);
    const double vc0 = z.hasCapacitor() ? between(-range, range) : 0;
    // Short enough that the oracle's steps are fine compared with the fastest time constant.
    const double fastest =
        z.hasCapacitor() ? z.seriesOhm * z.parallelOhm / (z.seriesOhm + z.parallelOhm) * z.capacitance_F : 1e-3;
    drive.duration_s = std::min(logBetween(1e-6, 2e-3), 500 * fastest);
    expectMatchesOracle(z, drive, vc0, limits);
    RC_ASSERT(!testing::Test::HasFailure());
}

TEST(Respond, SolvesTheMomentAtWhichComplianceIsReached) {
    // 10 mA into 200 Ω + (10 kΩ ∥ 50 nF): v = 2 + 100(1 − exp(−t/0.5 ms)) reaches 20 V.
    const double expected = -0.5e-3 * std::log(1 - 0.18);
    const auto response = respond(kRc, {Drive::Current, 10e-3, 10e-3, 400e-6}, 0, {20, 1});
    ASSERT_EQ(response.count, 2U);
    EXPECT_NEAR(response.items[1].start_s, expected, 1e-15);
    EXPECT_FALSE(response.items[0].limited);
    EXPECT_TRUE(response.items[1].limited);
    EXPECT_TRUE(response.limited());
    EXPECT_NEAR(response.voltage(400e-6), 20, 1e-12);
    EXPECT_LT(response.current(400e-6), 10e-3);
}

TEST(Respond, GivesAResistorOhmsLaw) {
    const auto response = respond({500, 0, 0, false}, {Drive::Voltage, -40, -40, 200e-6}, 123, {});
    ASSERT_EQ(response.count, 1U);
    EXPECT_DOUBLE_EQ(response.current(0), -0.08);
    EXPECT_DOUBLE_EQ(response.items[0].charge(), -0.08 * 200e-6);
    EXPECT_DOUBLE_EQ(response.items[0].energy(), 3.2 * 200e-6);
    EXPECT_EQ(response.endCapacitorVoltage, 0) << "a resistor remembers nothing";
}

TEST(Respond, LetsNoCurrentThroughAnOpenLoad) {
    const Circuit open = circuitAt(Load::openCircuit(), 0);
    const SourceLimits limits{60, 1};
    const auto voltage = respond(open, {Drive::Voltage, 40, 40, 1e-4}, 0, limits);
    EXPECT_DOUBLE_EQ(voltage.voltage(5e-5), 40);
    EXPECT_EQ(voltage.current(5e-5), 0);
    const auto current = respond(open, {Drive::Current, -1e-3, -1e-3, 1e-4}, 0, limits);
    EXPECT_DOUBLE_EQ(current.voltage(5e-5), -60) << "the source goes to its compliance";
    EXPECT_EQ(current.current(5e-5), 0);
    EXPECT_TRUE(current.limited());
    EXPECT_EQ(respond(open, {Drive::Current, -1e-3, -1e-3, 1e-4}, 0, {}).voltage(0), 0);
    EXPECT_EQ(respond(open, {Drive::HighImpedance, 0, 0, 1e-4}, 0, limits).voltage(0), 0);
    const auto ramp = respond(open, {Drive::Current, -1e-3, 1e-3, 1e-4}, 0, limits);
    EXPECT_DOUBLE_EQ(ramp.voltage(1e-5), -60);
    EXPECT_DOUBLE_EQ(ramp.voltage(9e-5), 60);
}

TEST(Respond, LetsACapacitorLeakThroughItselfWhileContactIsLost) {
    Circuit lost = kRc;
    lost.open = true;
    const auto response = respond(lost, {Drive::Voltage, 40, 40, 0.5e-3}, 30, {});
    EXPECT_NEAR(response.endCapacitorVoltage, 30 * std::exp(-1.0), 1e-9);
    EXPECT_DOUBLE_EQ(response.voltage(1e-4), 40);
}

TEST(Respond, HoldsAShortAtTheSourcesCurrentLimit) {
    const Circuit wire = circuitAt(Load::shortCircuit(), 0);
    const auto response = respond(wire, {Drive::Voltage, 40, 40, 1e-4}, 0, {50, 0.2});
    EXPECT_DOUBLE_EQ(response.current(5e-5), 0.2);
    EXPECT_NEAR(response.voltage(5e-5), 0.02, 1e-12);
    EXPECT_TRUE(response.limited());
}

TEST(Respond, KeepsItsIntegralsExactForVeryShortStretches) {
    // 1 ns of a ramp with a time constant 5·10⁵ times longer: the trapezoid gives the charge to a few parts in 10⁹.
    const auto response = respond(kRc, {Drive::Current, 0, 8e-3, 1e-9}, 10, {});
    EXPECT_NEAR(response.items[0].charge(), 4e-12, 1e-20);
    EXPECT_NEAR(response.items[0].currentSquared(), 64e-6 / 3 * 1e-9, 1e-22);
    EXPECT_NEAR(response.items[0].energy(), (10 * 4e-3 + 200 * 64e-6 / 3) * 1e-9,
                1e-15);  // the capacitor's voltage changes by 80 µV
}

const Circuit kRcLoad = circuitAt(benchRcLoad(), 0);

PulseSegments biphasic(Drive drive, double level, double width, double gap, Drive inGap) {
    PulseSegments pulse;
    pulse.items[pulse.count++] = {drive, level, level, width};
    if (gap > 0) pulse.items[pulse.count++] = {inGap, 0, 0, gap};
    pulse.items[pulse.count++] = {drive, -level, -level, width};
    return pulse;
}

DriveSegment rest(Drive drive, double duration) { return {drive, 0, 0, duration}; }

/// Returns the peak for 40 V into the RC load, integrated numerically (tests/reference/loads.py).
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
        // All the energy ends in the two resistors; the heat of the series resistor is a lower bound.
        EXPECT_GT(totals.energy_J, totals.currentSquared_A2s * 200);
    }
}

}  // namespace
}  // namespace tacto
