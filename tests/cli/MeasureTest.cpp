// measure: files for which the right answer is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Result.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

/// Returns a file with 1 V and 5 V alternating, 5 ms each, at 100 kS/s.
std::string squareWave() {
    std::string text = "time_s,voltage_v,current_a\n";
    for (int i = 0; i < 20000; ++i) {
        const double volts = (i / 500) % 2 ? 5.0 : 1.0;
        text += fmt::format("{:.6f},{},{}\n", i * 1e-5, volts, volts / 1000);
    }
    return text;
}

/// Returns two symmetric biphasic pulses of 20 V, 200 us per phase, gap 100 us, 100 ms apart, at 250 kS/s.
std::string biphasic() {
    std::string text = "time_s,voltage_v\n";
    for (int i = 0; i < 50000; ++i) {
        const int k = i % 25000 - 1000;
        const double volts = k >= 0 && k < 50 ? 20 : k >= 75 && k < 125 ? -20 : 0;
        text += fmt::format("{:.6f},{}\n", i * 4e-6, volts);
    }
    return text;
}

void expectMean(const Json& statistic, double mean, double tolerance) {
    ASSERT_TRUE(statistic["mean"].is_number()) << statistic.dump();
    EXPECT_NEAR(statistic["mean"].get<double>(), mean, tolerance);
}

TEST(Measure, ASquareWaveHasTopMinusBaseWidthAndOnsetToOnsetInterval) {
    const Desk desk;
    const auto ran = desk.run({"measure", desk.write("square.csv", squareWave()), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    expectKeys(value, {"channels", "warnings"}, "measure");
    ASSERT_EQ(value["channels"].size(), 2U);
    for (const auto& channel : value["channels"]) {
        expectKeys(channel, {"name", "unit", "rate_hz", "samples", "pulses"}, "a channel");
        for (const auto* statistic : {"amplitude", "width_s", "interval_s", "rise_s", "fall_s", "imbalance"})
            expectStatistic(channel[statistic], statistic);
        EXPECT_NEAR(channel["rate_hz"].get<double>(), 1e5, 1);
        EXPECT_EQ(channel["samples"], 20000);
        EXPECT_NEAR(channel["pulses"].get<double>(), 20, 1);
        expectMean(channel["width_s"], 0.005, 1e-6);
        expectMean(channel["interval_s"], 0.010, 1e-6);
        EXPECT_EQ(channel["imbalance"]["n"], 0);
    }
    EXPECT_EQ(value["channels"][0]["unit"], "V");
    expectMean(value["channels"][0]["amplitude"], 4, 1e-6);
    EXPECT_EQ(value["channels"][1]["unit"], "A");
    expectMean(value["channels"][1]["amplitude"], 0.004, 1e-8);
}

TEST(Measure, ABiphasicPulseHasItsLeadingPlateauAndItsImbalance) {
    const Desk desk;
    const auto value = jsonOf(desk.run({"measure", desk.write("biphasic.csv", biphasic()), "--json"}));
    ASSERT_EQ(value["channels"].size(), 1U);
    const auto& channel = value["channels"][0];
    EXPECT_EQ(channel["pulses"], 2);
    expectMean(channel["amplitude"], 20, 0.01);
    expectMean(channel["width_s"], 200e-6, 4e-6);
    expectMean(channel["interval_s"], 0.1, 4e-6);
    expectMean(channel["imbalance"], 0, 0.02);
}

TEST(Measure, AChannelIsChosenByNameAndAShuntMakesVoltsAmperes) {
    const Desk desk;
    const auto file = desk.write("square.csv", squareWave());
    const auto all = jsonOf(desk.run({"measure", file, "--json"}));
    const auto first = all["channels"][0]["name"].get<std::string>();
    const auto one = jsonOf(desk.run({"measure", file, "--channel", first, "--json"}));
    ASSERT_EQ(one["channels"].size(), 1U);
    EXPECT_EQ(one["channels"][0], all["channels"][0]);
    const auto shunt = jsonOf(desk.run({"measure", file, "--channel", first, "--shunt", "10", "--json"}));
    EXPECT_EQ(shunt["channels"][0]["unit"], "A");
    expectMean(shunt["channels"][0]["amplitude"], 0.4, 1e-6);
    expectRefused(desk.run({"measure", file, "--channel", "loudness"}), 2, {"loudness", first});
    expectRefused(desk.run({"measure", file, "--shunt", "0"}), 2, {"shunt", "0"});
    expectRefused(desk.run({"measure", file, "--shunt", "wide"}), 2, {"shunt", "wide"});
}

TEST(Measure, ASignalWithoutTwoStatesHasNoPulsesAndAWarning) {
    const Desk desk;
    std::string flat = "time_s,voltage_v\n";
    for (int i = 0; i < 2000; ++i) flat += fmt::format("{:.6f},1.0\n", i * 1e-5);
    const auto ran = desk.run({"measure", desk.write("flat.csv", flat), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["channels"][0]["pulses"], 0);
    EXPECT_TRUE(value["channels"][0]["amplitude"]["mean"].is_null());
    ASSERT_EQ(value["warnings"].size(), 1U);
    EXPECT_THAT(value["warnings"][0].get<std::string>(), testing::HasSubstr("two states"));
}

TEST(Measure, WhatIsNoCaptureExitsThreeWithFileAndLine) {
    const Desk desk;
    expectRefused(desk.run({"measure", desk.at("none.csv")}), 3, {"none.csv"});
    expectRefused(desk.run({"measure", desk.path().string()}), 3, {desk.path().string(), "file"});
    expectRefused(desk.run({"measure", desk.write("empty.csv", "")}), 3, {"empty.csv", "empty"});
    expectRefused(desk.run({"measure", desk.write("text.csv", "time_s,voltage_v\n0,1\n1e-6,much\n")}), 3,
                  {"text.csv:3", "much", "number"});
}

}  // namespace
}  // namespace tacto::test
