// The figures of pulses and loads: `measure`, the known load and the load-safety check.
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/load_safety/LoadReading.h"
#include "core/measure/LoadMeasurement.h"
#include "tests/coverage/CoverageTable.h"
#include "tests/coverage/TwinRuns.h"

namespace tacto::test {
namespace {

constexpr double kVolts = 30, kRange_v = 45, kWidth_s = 200e-6, kInterval_s = 0.53, kRise_s = 100e-9;

/// Captures two trains with `pulses` pulses each.
std::vector<Capture> twoTrains(TwinRuns& runs, int pulses) {
    const auto train = twinTrain(kVolts, 200, 100, pulses, runs.truth.train_hz);
    return runs.captured({train, train}, kRange_v, {kInterval_s});
}

TEST(Coverage, PulsesInACapture) {
    RecordProperty("hazard", "H9");
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        TwinRuns runs(seed);
        const auto captures = twoTrains(runs, 1);
        const auto volts = measureTrains(captures, "voltage", {}).value();
        const auto& u = volts.uncertainty;
        const auto& truth = runs.truth;
        const double height = truth.volts(kVolts), width = kWidth_s + truth.width_s;
        table.add("amplitude", height, volts.amplitude.mean, kCoverage * u.amplitude);
        table.add("width", width, volts.pulses.front().leading.width_s, kCoverage * u.width_s);
        table.add("gap", 100e-6 + truth.gap_s, volts.pulses.front().gap_s, kCoverage * u.gap_s);
        table.add("interval", kInterval_s, volts.interval_s.mean, kCoverage * u.interval_s);
        table.add("charge", height * width, volts.charge.mean, kCoverage * u.charge);
        const double weaker = std::max(0.0, truth.imbalance);  // the larger phase is the second if that is stronger
        const double imbalance = truth.imbalance > 0 ? weaker : -truth.imbalance / (1 - truth.imbalance);
        table.add("imbalance", imbalance, volts.imbalance.mean, kCoverage * u.imbalance);
        const auto load = measureLoad(captures.front(), 0, 1).value();
        table.add("load", truth.ohms, load.load_ohm.mean, kCoverage * load.loadUncertainty_ohm);
    }
    const Promise rectangle{.most = 1,
                            .mostWithinHalf = 0.92,
                            .because = "k is 2 throughout, as printed: of one rectangle all lies within 1.73 u"};
    for (const char* figure : {"amplitude", "width", "gap", "interval", "charge", "imbalance", "load"})
        table.promise(figure, rectangle);
    table.judge("pulses");
}

struct LoadFigure {
    const char* name;
    Reading LoadReading::*reading;
    double truth;
};

std::vector<LoadFigure> loadFigures(const TwinTruth& truth, int pulses) {
    const double volts = truth.volts(kVolts), amps = volts / truth.ohms, width = kWidth_s + truth.width_s;
    const double second = 1 - truth.imbalance, larger = std::max(1.0, second);
    // Integrates the square of a trapezoid whose width at half height is the phase's width.
    const double squares = amps * amps * (width - kRise_s / 3) * (1 + second * second);
    const double net = amps * width * std::abs(truth.imbalance);
    const double in1s = 2 * pulses, in5s = 10 * pulses;
    return {{"amplitude", &LoadReading::amplitude_v, volts},
            {"highest amplitude", &LoadReading::highest_v, volts},
            {"amplitude over the command", &LoadReading::delivered, volts / kVolts},
            {"current", &LoadReading::amplitude_ma, 1e3 * amps},
            {"width", &LoadReading::width_s, width},
            {"interval", &LoadReading::interval_s, kInterval_s},
            {"|Z|", &LoadReading::impedance_ohm, truth.ohms},
            {"peak voltage", &LoadReading::peak_v, volts * larger},
            {"peak current", &LoadReading::peak_ma, 1e3 * amps * larger},
            {"charge", &LoadReading::charge_uc, 1e6 * amps * width * larger},
            {"net charge", &LoadReading::net_charge_uc, 1e6 * net},
            {"imbalance", &LoadReading::imbalance, std::abs(truth.imbalance) / larger},
            {"energy", &LoadReading::energy_mj, 1e3 * truth.ohms * squares},
            {"RMS current in the train", &LoadReading::rms_train_ma,
             1e3 * std::sqrt(squares * (pulses > 1 ? truth.train_hz : 100))},
            {"RMS current over 1 s", &LoadReading::rms_1s_ma, 1e3 * std::sqrt(in1s * squares)},
            {"RMS current over 5 s", &LoadReading::rms_5s_ma, 1e3 * std::sqrt(in5s * squares / 5)},
            {"RMS voltage over 5 s", &LoadReading::rms_5s_v, truth.ohms * std::sqrt(in5s * squares / 5)},
            {"mean current over 5 s", &LoadReading::dc_ma, 1e3 * in5s * net / 5},
            {"power over 1 s", &LoadReading::power_1s_w, in1s * truth.ohms * squares}};
}

TEST(Coverage, TrainsOnALoad) {
    RecordProperty("hazard", "H9");
    for (const int pulses : {1, 3}) {
        CoverageTable table;
        for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
            TwinRuns runs(seed);
            ExpectedTrain expected;
            expected.pulses = pulses;
            if (pulses > 1) expected.rate_hz = runs.truth.train_hz;
            expected.programmed = {kVolts, kVolts};
            const auto found = readLoad(twoTrains(runs, pulses), expected).value();
            for (const auto& figure : loadFigures(runs.truth, pulses)) {
                const Reading& read = found.*figure.reading;
                table.add(figure.name, figure.truth, read.value, read.expanded);
            }
            if (pulses > 1)
                table.add("rate in the train", runs.truth.train_hz, found.rate_hz.value, found.rate_hz.expanded);
        }
        // Trains on one clock may all begin at the same place between two samples.
        table.promise("width", {.most = 1,
                                .mostWithinHalf = 1,
                                .because = "the widths of two trains are not known to differ in where samples fall"});
        if (pulses > 1) {
            table.promise(
                "rate in the train",
                {.most = 1, .because = "the rates of two trains are not known to differ in where samples fall"});
        }
        const Promise alike{.most = 1,
                            .mostWithinHalf = 0.97,
                            .because = "pulses of a train are not known to differ in where their edges fall"};
        for (const char* figure : {"imbalance", "net charge", "mean current"})
            if (pulses > 1) table.promise(figure, alike);
        table.promise("|Z|", {.mostWithinHalf = 0.88,
                              .because = "the linearity's bound is that of its worst place, and the simulated one "
                                         "bends less elsewhere"});
        table.judge(fmt::format("load, trains of {}", pulses));
    }
}

}  // namespace
}  // namespace tacto::test
