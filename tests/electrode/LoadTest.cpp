#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/electrode/Load.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Load read(std::string_view text) {
    const auto load = parseLoad(text);
    EXPECT_TRUE(load) << text << ": " << (load ? "" : load.error().message);
    return load.value_or(Load::openCircuit());
}

TEST(ParseLoad, ReadsResistances) {
    EXPECT_EQ(read("500 ohm"), Load::resistor(Ohms(500)));
    EXPECT_EQ(read("500ohm"), Load::resistor(Ohms(500)));
    EXPECT_EQ(read("500"), Load::resistor(Ohms(500)));
    EXPECT_EQ(read(" 1 kohm "), Load::resistor(Ohms(1000)));
    EXPECT_EQ(read("10k"), Load::resistor(Ohms(10'000)));
    EXPECT_EQ(read("2.2 kΩ"), Load::resistor(Ohms(2200)));
    EXPECT_EQ(read("1 Mohm"), Load::resistor(Ohms(1e6)));
}

TEST(ParseLoad, ReadsTheSkinEquivalentHoweverItIsWritten) {
    for (const char* text : {"200 ohm + 10 kohm || 50 nF", "200 ohm + (10 kohm || 50 nF)", "200+10k||50nF",
                             "0.2 kΩ + 10 kΩ ∥ 50 nF", "200 ohm + 10 kohm || 0.05 uF", "200 + 10k ∥ 50n F"}) {
        const Load load = read(text);
        EXPECT_EQ(load.kind, LoadKind::SkinEquivalent) << text;
        EXPECT_DOUBLE_EQ(load.series.value(), 200) << text;
        EXPECT_DOUBLE_EQ(load.parallel.value(), 10'000) << text;
        EXPECT_DOUBLE_EQ(load.capacitance.value(), 50) << text;
    }
}

TEST(ParseLoad, ReadsOpenAndShort) {
    EXPECT_EQ(read("open").kind, LoadKind::Open);
    EXPECT_EQ(read("short").kind, LoadKind::Short);
}

TEST(ParseLoad, ReadsModifiers) {
    const Load load = read(
        "200 ohm + 10 kohm || 50 nF, halves at 20 V, drift -0.1 %/s, open 1.5 s to 1.7 s, "
        "open 200 ms to 300 ms, intermittent 5 % seed 3");
    EXPECT_DOUBLE_EQ(load.halvingVoltage.value(), 20);
    EXPECT_DOUBLE_EQ(load.driftPerSecond, -0.001);
    ASSERT_EQ(load.windowCount, 2U);
    EXPECT_EQ(load.windows[0], (OpenWindow{1.5, 1.7}));
    EXPECT_EQ(load.windows[1], (OpenWindow{0.2, 0.3}));
    EXPECT_DOUBLE_EQ(load.openFraction, 0.05);
    EXPECT_EQ(load.openSeed, 3U);
}

TEST(ParseLoad, RefusesAnythingElseNamingTheTextAndWhatIsAccepted) {
    for (const char* bad :
         {"",
          "lots",
          "-5 ohm",
          "0 ohm",
          "nan ohm",
          "inf",
          "500 ohm 3",
          "5 volt",
          "200 + 10k",
          "200 + 10k || 50",
          "200 + 10k || 0 nF",
          "200 + 10k || nan nF",
          "200 || 50 nF",
          "+",
          "1e12",
          "500 ohm, ",
          "500 ohm, shaky",
          "500 ohm, halves at 20 V",
          "500 ohm, drift fast",
          "500 ohm, open 2 s to 1 s",
          "500 ohm, open 1 s",
          "500 ohm, intermittent 101 %",
          "500 ohm, intermittent 5 % seed x",
          "500 ohm, drift nan %/s",
          "open, open 0 s to 1 s, open 1 s to 2 s, open 2 s to 3 s, open 3 s to 4 s, open 5 s to 6 s"}) {
        const auto load = parseLoad(bad);
        ASSERT_FALSE(load) << '"' << bad << '"';
        EXPECT_EQ(load.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(load.error().message, AllOf(HasSubstr(std::string("load \"") + bad + '"'), HasSubstr("500 ohm")));
    }
}

TEST(Load, TextReadsBackToTheSameLoad) {
    for (const auto& [name, load] : benchLoads()) EXPECT_EQ(load.text(), name);
    for (const char* text : {"123.456 ohm", "2.2 Mohm", "200 ohm + 10 kohm || 50 nF, halves at 20 V, drift -0.25 %/s",
                             "1 kohm, open 1.5 s to 1.7 s, intermittent 5 % seed 3"}) {
        const Load load = read(text);
        EXPECT_EQ(read(load.text()), load) << load.text();
    }
}

TEST(BenchLoads, AreTheNineOfTheStandardCheck) {
    ASSERT_EQ(benchLoads().size(), 9U);
    for (const auto& [name, load] : benchLoads()) EXPECT_EQ(read(name), load) << name;
    EXPECT_EQ(benchLoads().back().load, benchRcLoad());
}

TEST(Scaled, MultipliesTheImpedanceAndKeepsTheTimeConstant) {
    const Load load = scaled(benchRcLoad(), 0.8);
    EXPECT_DOUBLE_EQ(load.series.value(), 160);
    EXPECT_DOUBLE_EQ(load.parallel.value(), 8000);
    EXPECT_DOUBLE_EQ(load.parallel.value() * load.capacitance.value(), 10'000.0 * 50.0);
    EXPECT_DOUBLE_EQ(scaled(Load::resistor(Ohms(500)), 1.2).series.value(), 600);
    EXPECT_EQ(scaled(Load::openCircuit(), 1.2), Load::openCircuit());
    EXPECT_EQ(scaled(Load::shortCircuit(), 1.2), Load::shortCircuit());
}

TEST(EffectiveImpedance, OfTheRcLoadDependsOnTheKindOfSource) {
    const DriveSegment voltage{Drive::Voltage, 40, 40, 200e-6};
    const DriveSegment current{Drive::Current, 4e-3, 4e-3, 200e-6};
    const auto& scipy = test::figuresOf("loads").at("bench_load_impedance_ohm");
    EXPECT_NEAR(effectiveImpedance(benchRcLoad(), voltage).value(), scipy.at("voltage").get<double>(), 1e-3);
    EXPECT_NEAR(effectiveImpedance(benchRcLoad(), current).value(), scipy.at("current").get<double>(), 1e-6);
}

TEST(EffectiveImpedance, OfAResistorIsItselfWhateverDrivesIt) {
    for (const double r : {100.0, 1e3, 1e5}) {
        const Load load = Load::resistor(Ohms(r));
        EXPECT_NEAR(effectiveImpedance(load, {Drive::Voltage, -10, -10, 1e-4}).value(), r, 1e-9 * r);
        EXPECT_NEAR(effectiveImpedance(load, {Drive::Current, 1e-3, 1e-3, 1e-4}).value(), r, 1e-9 * r);
    }
}

TEST(EffectiveImpedance, IsInfiniteWhenOpenAndTinyWhenShort) {
    const DriveSegment pulse{Drive::Voltage, 1, 1, 1e-4};
    EXPECT_TRUE(std::isinf(effectiveImpedance(Load::openCircuit(), pulse).value()));
    EXPECT_NEAR(effectiveImpedance(Load::shortCircuit(), pulse).value(), kShortOhms, 1e-12);
}

TEST(EffectiveImpedance, ScalesWithTheLoad) {
    const DriveSegment pulse{Drive::Current, 4e-3, 4e-3, 200e-6};
    const double nominal = effectiveImpedance(benchRcLoad(), pulse).value();
    EXPECT_NEAR(effectiveImpedance(scaled(benchRcLoad(), 1.2), pulse).value(), 1.2 * nominal, 1e-6);
}

TEST(CircuitAt, DriftsWithTime) {
    const Load load = read("1 kohm, drift 0.1 %/s");
    EXPECT_DOUBLE_EQ(circuitAt(load, 0).seriesOhm, 1000);
    EXPECT_DOUBLE_EQ(circuitAt(load, 100).seriesOhm, 1100);
    EXPECT_DOUBLE_EQ(circuitAt(load, 1e9).seriesOhm, 100'000) << "held within a hundred times";
    EXPECT_DOUBLE_EQ(circuitAt(read("1 kohm, drift -1 %/s"), 1000).seriesOhm, 10);
}

TEST(CircuitAt, OpensInTheDeclaredWindows) {
    const Load load = read("1 kohm, open 1 s to 2 s, open 3 s to 4 s");
    for (const double closed : {0.0, 0.999, 2.0, 2.5, 4.0}) EXPECT_FALSE(circuitAt(load, closed).open) << closed;
    for (const double open : {1.0, 1.5, 1.999, 3.0}) EXPECT_TRUE(circuitAt(load, open).open) << open;
    EXPECT_TRUE(circuitAt(Load::openCircuit(), 0).open);
}

TEST(CircuitAt, LosesContactInASeededPatternWithTheStatedProbability) {
    Load load = read("1 kohm, intermittent 5 % seed 3");
    const auto openCells = [](const Load& l) {
        int open = 0;
        for (int cell = 0; cell < 20'000; ++cell) open += l.isOpenAt((cell + 0.5) * Load::kContactCell_s) ? 1 : 0;
        return open;
    };
    EXPECT_NEAR(openCells(load), 1000, 5 * std::sqrt(20'000 * 0.05 * 0.95));
    int differs = 0;
    Load other = load;
    other.openSeed = 4;
    for (int cell = 0; cell < 20'000; ++cell) {
        const double t = (cell + 0.5) * Load::kContactCell_s;
        EXPECT_EQ(load.isOpenAt(t), load.isOpenAt(t));
        differs += load.isOpenAt(t) != other.isOpenAt(t) ? 1 : 0;
    }
    EXPECT_GT(differs, 1000) << "another seed, another pattern";
    load.openFraction = 0;
    EXPECT_EQ(openCells(load), 0);
}

TEST(CircuitAt, LetsTheParallelResistanceFallWithIntensity) {
    const Load load = read("200 ohm + 10 kohm || 50 nF, halves at 20 V");
    const auto parallelAt = [&](double volts) {
        const DriveSegment pulse{Drive::Voltage, volts, volts, 10e-3};  // long: V across R_p settles at V·10/10.2
        return circuitAt(load, 0, {&pulse, 1}).parallelOhm;
    };
    EXPECT_NEAR(parallelAt(20 * 10.2 / 10), 5000, 1e-6);
    EXPECT_NEAR(parallelAt(-20 * 10.2 / 10), 5000, 1e-6) << "the sign does not matter";
    EXPECT_NEAR(parallelAt(60 * 10.2 / 10), 2500, 1e-6);
    EXPECT_DOUBLE_EQ(circuitAt(load, 0).parallelOhm, 10'000) << "without a pulse, the resting value";
    double last = parallelAt(0);
    EXPECT_DOUBLE_EQ(last, 10'000);
    for (double v = 1; v < 100; v += 1) {
        EXPECT_LT(parallelAt(v), last);
        last = parallelAt(v);
    }
}

}  // namespace
}  // namespace tacto
