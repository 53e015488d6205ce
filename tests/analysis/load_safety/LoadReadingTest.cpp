#include <gtest/gtest.h>

#include "core/analysis/load_safety/LoadReading.h"
#include "tests/analysis/load_safety/LoadCaptures.h"

namespace tacto {
namespace {

using test::loadCaptures;
using test::LoadTruth;

LoadReading read(const LoadTruth& truth, int trains = 2) {
    return readLoad(loadCaptures(truth, trains), ExpectedTrain{1, 100}).value();
}

/// Expects the truth within the expanded uncertainty, and this uncertainty below the share `worst` of the truth.
void expectTruth(const Reading& reading, double truth, double worst, const char* what) {
    ASSERT_TRUE(reading.measured()) << what;
    EXPECT_NEAR(reading.value, truth, std::max(reading.expanded, 1e-12)) << what;
    EXPECT_LE(reading.expanded, worst * std::abs(truth)) << what;
}

TEST(LoadReading, MeasuresEveryQuantityOfFortyVoltsInto500Ohm) {
    const auto found = read({});
    // With edges of 100 ns, charge depends on the width at half height; squares lose a third of an edge for each edge.
    const double squares = 0.08 * 0.08 * 2 * (200e-6 - 100e-9 / 3);
    expectTruth(found.amplitude_v, 40, 0.01, "amplitude");
    expectTruth(found.amplitude_ma, 80, 0.01, "current");
    expectTruth(found.width_s, 200e-6, 0.001, "width");
    expectTruth(found.interval_s, 0.5, 1e-6, "interval");
    expectTruth(found.impedance_ohm, 500, 0.012, "impedance");
    expectTruth(found.peak_v, 40, 0.01, "peak voltage");
    expectTruth(found.peak_ma, 80, 0.01, "peak current");
    expectTruth(found.charge_uc, 16, 0.01, "phase charge");
    expectTruth(found.energy_mj, 1e3 * 500 * squares, 0.015, "energy");
    expectTruth(found.rms_train_ma, 1e3 * std::sqrt(squares / 0.01), 0.01, "in-train RMS");
    expectTruth(found.rms_1s_ma, 1e3 * std::sqrt(2 * squares), 0.01, "RMS over 1 s");
    expectTruth(found.rms_5s_ma, 1e3 * std::sqrt(10 * squares / 5), 0.01, "RMS over 5 s");
    expectTruth(found.rms_5s_v, 500 * std::sqrt(10 * squares / 5), 0.01, "RMS voltage over 5 s");
    EXPECT_LE(found.imbalance.value, 1e-4);
    EXPECT_TRUE(found.biphasic);
}

TEST(LoadReading, TheRateWithinATrainIsMeasuredAndNotBelieved) {
    RecordProperty("hazard", "H9");
    LoadTruth truth;
    truth.pulses = 4;
    truth.train_hz = 105;
    truth.rate_hz = 1e6;
    truth.timeBase = 1 + 50e-6;
    truth.timeBaseTolerance = 100e-6;
    const auto found = readLoad(loadCaptures(truth), ExpectedTrain{4, 100}).value();
    expectTruth(found.rate_hz, 105, 0.001, "rate");
    const double squares = 0.08 * 0.08 * 4 * 2 * (200e-6 - 100e-9 / 3);
    expectTruth(found.rms_train_ma, 1e3 * std::sqrt(squares * 105 / 4), 0.02, "in-train RMS");
    EXPECT_FALSE(read({}).rate_hz.measured()) << "a single pulse has none";
}

TEST(LoadReading, AnInstrumentsOffsetChangesNothing) {
    RecordProperty("hazard", "H5");
    LoadTruth truth;
    truth.offset_v = 1.3;
    truth.offset_a = 0.003;
    const auto found = read(truth);
    EXPECT_NEAR(found.amplitude_v.value, 40, 0.03);
    EXPECT_LE(found.imbalance.value, 2 * found.imbalance.expanded);
}

TEST(LoadReading, NetChargeIsFoundToATenthOfAPercent) {
    RecordProperty("hazard", "H5");
    for (const double missing : {0.0, 0.005, 0.01, 0.02, 0.1, -0.02}) {
        LoadTruth truth;
        truth.second = 1 - missing;
        const auto found = read(truth);
        const double expected = std::abs(missing) / std::max(1.0, 1 - missing);
        EXPECT_NEAR(found.imbalance.value, expected, found.imbalance.expanded) << missing;
        EXPECT_LE(found.imbalance.expanded, 0.002) << missing;
    }
}

TEST(LoadReading, GainErrorsOfTheInstrumentStayWithinTheStatedUncertainty) {
    for (const double gain : {0.9955, 1.0045}) {
        LoadTruth truth;
        truth.gain_v = gain;
        truth.gain_i = 2 - gain;
        const auto found = read(truth);
        expectTruth(found.amplitude_v, 40, 0.01, "amplitude");
        expectTruth(found.rms_5s_ma, 80 * std::sqrt(10 * 400e-6 / 5), 0.01, "RMS");
    }
}

TEST(LoadReading, OneTrainHasNoIntervalAndNoWindowLongerThanItself) {
    RecordProperty("hazard", "H9");
    const auto found = read({}, 1);
    EXPECT_FALSE(found.interval_s.measured());
    EXPECT_FALSE(found.rms_1s_ma.measured());
    EXPECT_FALSE(found.rms_5s_ma.measured());
    EXPECT_FALSE(found.power_1s_w.measured());
    EXPECT_TRUE(found.rms_train_ma.measured());
}

TEST(LoadReading, ACurrentBelowTenLsbIsNotEvaluated) {
    RecordProperty("hazard", "H9");
    auto captures = loadCaptures({});
    for (auto& capture : captures) capture.channels[1].lsb = 0.0081;  // 80 mA are 9.9 steps
    const auto found = readLoad(captures, ExpectedTrain{}).value();
    EXPECT_TRUE(found.underTenLsb);
    EXPECT_FALSE(found.peak_ma.measured());
    EXPECT_FALSE(found.impedance_ohm.measured());
    EXPECT_TRUE(found.peak_v.measured());
    ASSERT_FALSE(found.warnings.empty());
    EXPECT_NE(found.warnings.back().find("below 10 LSB"), std::string::npos);
}

TEST(LoadReading, AClippedCurrentIsNotMeasured) {
    RecordProperty("hazard", "H9");
    auto captures = loadCaptures({});
    captures[1].channels[1].high = 0.05;  // only the second train
    const auto found = readLoad(captures, ExpectedTrain{}).value();
    EXPECT_FALSE(found.peak_ma.measured());
    EXPECT_FALSE(found.rms_5s_ma.measured());
    EXPECT_FALSE(found.warnings.empty());
}

TEST(LoadReading, ATrainThatCannotBeReadLeavesNothingMeasured) {
    RecordProperty("hazard", "H9");
    auto captures = loadCaptures({});
    captures[1].channels[0].samples[2500] = std::numeric_limits<float>::quiet_NaN();
    const auto found = readLoad(captures, ExpectedTrain{}).value();
    EXPECT_FALSE(found.peak_v.measured());
    EXPECT_FALSE(found.rms_5s_ma.measured());
}

TEST(LoadReading, FewerPulsesThanCommandedAreNotMeasured) {
    const auto found = readLoad(loadCaptures({}), ExpectedTrain{3, 100}).value();
    EXPECT_FALSE(found.peak_v.measured());
    ASSERT_FALSE(found.warnings.empty());
    EXPECT_NE(found.warnings.front().find("3 were commanded"), std::string::npos) << found.warnings.front();
}

TEST(LoadReading, BehindAClippedSpikeTheFineRangeIsRead) {
    RecordProperty("hazard", "H5");
    LoadTruth truth;
    truth.second = 0.98;
    const auto wide = loadCaptures(truth);
    auto fine = wide;
    for (auto& capture : fine) {
        auto& current = capture.channels[1];
        const auto onset = static_cast<std::size_t>(120e-6 * capture.rate_hz);
        for (std::size_t k = 0; k < 300; ++k) current.samples[onset + k] = static_cast<float>(current.high);
    }
    EXPECT_FALSE(readLoad(fine, ExpectedTrain{}).value().impedance_ohm.measured());
    const auto found = readLoad(wide, ExpectedTrain{}, fine).value();
    ASSERT_TRUE(found.impedance_ohm.measured());
    EXPECT_NEAR(found.impedance_ohm.value, 500, found.impedance_ohm.expanded);
    EXPECT_NEAR(found.imbalance.value, 0.02, found.imbalance.expanded);
    EXPECT_LE(found.imbalance.expanded, 0.005);
}

/// Returns the same trains from a current source into `truth.ohms`, in series with a parallel resistor and capacitor.
std::vector<Capture> intoSkin(const LoadTruth& truth, double parallel, double farads) {
    auto captures = loadCaptures(truth);
    for (auto& capture : captures) {
        auto& voltage = capture.channels[0];
        voltage.high = 30;
        voltage.low = -voltage.high;
        voltage.lsb = 2 * voltage.high / std::ldexp(1, truth.bits);
        const double decay = std::exp(-1 / (capture.rate_hz * parallel * farads));
        double held = 0;
        for (std::size_t k = 0; k < voltage.samples.size(); ++k) {
            const double amps = static_cast<double>(capture.channels[1].samples[k]);
            held = held * decay + amps * parallel * (1 - decay);
            const double volts = truth.ohms * amps + held;
            voltage.samples[k] = static_cast<float>(std::round(volts / voltage.lsb) * voltage.lsb);
        }
    }
    return captures;
}

TEST(LoadReading, OfACurrentSourceTheCurrentTellsThePhases) {
    RecordProperty("hazard", "H9");
    LoadTruth truth;
    truth.volts = 1;
    truth.ohms = 200;  // 5 mA
    const double parallel = 10e3, farads = 50e-9;
    const auto found = readLoad(intoSkin(truth, parallel, farads), ExpectedTrain{1, 100, Drive::Current}).value();
    expectTruth(found.width_s, 200e-6, 0.001, "width");
    expectTruth(found.amplitude_ma, 5, 0.01, "current");
    expectTruth(found.charge_uc, 1, 0.01, "phase charge");
    EXPECT_LE(found.imbalance.value, found.imbalance.expanded);
    // The value at the end of the phase, as defined in science.md section 4: 3.50 kohm.
    const double ohms = truth.ohms + parallel * (1 - std::exp(-truth.width_s / (parallel * farads)));
    EXPECT_NEAR(ohms, 3.5e3, 10);
    expectTruth(found.amplitude_v, 5e-3 * ohms, 0.025, "voltage");
    expectTruth(found.impedance_ohm, ohms, 0.025, "impedance");
    EXPECT_NEAR(found.impedance_ohm.value, ohms, 0.005 * ohms);
}

TEST(LoadReading, TrainsThatWereToldDifferentThingsAreEachReadAgainstTheirOwn) {
    LoadTruth stronger, weaker;
    weaker.volts = 0.9 * stronger.volts;
    auto captures = loadCaptures(stronger);
    captures[1] = loadCaptures(weaker)[1];
    const auto found = readLoad(captures, ExpectedTrain{.programmed = {40, 36}}).value();
    expectTruth(found.delivered, 1, 0.01, "delivered");
    expectTruth(found.impedance_ohm, 500, 0.012, "impedance");
    const auto unaware = readLoad(captures, ExpectedTrain{.programmed = {40, 40}}).value();
    EXPECT_GT(unaware.delivered.expanded, 0.05) << "their spread is programmed";
    EXPECT_FALSE(readLoad(captures, ExpectedTrain{}).value().delivered.measured());
    EXPECT_FALSE(readLoad(captures, ExpectedTrain{.programmed = {40}}));
}

TEST(LoadReading, ACurrentSourceIsNotReadWithoutItsCurrent) {
    RecordProperty("hazard", "H9");
    auto captures = loadCaptures({});
    for (auto& capture : captures) capture.channels.pop_back();
    const auto found = readLoad(captures, ExpectedTrain{1, 100, Drive::Current});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::NotFound);
    EXPECT_NE(found.error().message.find("\"current\""), std::string::npos) << found.error().message;
}

TEST(LoadReading, RefusesNoCapturesAndANonsensicalTrain) {
    EXPECT_FALSE(readLoad({}, ExpectedTrain{}));
    EXPECT_FALSE(readLoad(loadCaptures({}), ExpectedTrain{0, 100}));
    EXPECT_FALSE(readLoad(loadCaptures({}), ExpectedTrain{1, std::nan("")}));
}

}  // namespace
}  // namespace tacto
