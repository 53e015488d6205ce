// measure: uncertainty, quality and the load from voltage and current, as a user sees them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Random.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Returns a biphasic current of 5 mA, 200 us per phase, 50 ms apart, through 2 kohm, at 250 kS/s; the current is given
/// directly or as the voltage across 100 ohm.
std::string pulses(const std::string& header, double perAmpere) {
    Random random(4, "load file");
    std::string text = header + "\n";
    for (int i = 0; i < 50'000; ++i) {
        const int k = i % 12'500 - 1000;
        const double amperes = k >= 0 && k < 50 ? 5e-3 : k >= 75 && k < 125 ? -5e-3 : 0;
        text += fmt::format("{:.6f},{:.5f},{:.8f}\n", i * 4e-6, 2000 * amperes + 0.02 * random.normal(),
                            perAmpere * (amperes + 5e-6 * random.normal()));
    }
    return text;
}

/// Adds options with the figures that a data sheet would state.
Words stated(Words words) {
    for (const char* key :
         {"gain_pct=0.1", "probe_pct=0", "shunt_pct=0.1", "timebase_ppm=50", "lsb_v=0.001", "lsb_a=1e-6"}) {
        words.insert(words.end(), {"--accuracy", key});
    }
    return words;
}

double meanOf(const Json& statistic) { return statistic["mean"].get<double>(); }

TEST(MeasureLoad, AVoltageAndACurrentGiveTheLoad) {
    const Desk desk;
    const auto file = desk.write("pulses.csv", pulses("time_s,voltage_v,current_a", 1));
    const auto ran = desk.run(stated({"measure", file, "--json"}));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["not_stated"], "");
    const auto& load = value["load"];
    expectKeys(load,
               {"voltage", "current", "pulses", "load_ohm", "load_uncertainty_ohm", "impedance_ohm", "charge_c",
                "second_charge_c", "net_charge_c", "energy_j"},
               "load");
    EXPECT_EQ(load["pulses"], 4);
    EXPECT_NEAR(meanOf(load["load_ohm"]), 2000, 10);
    EXPECT_NEAR(meanOf(load["impedance_ohm"]), 2000, 10);
    EXPECT_NEAR(meanOf(load["charge_c"]), 1e-6, 0.01e-6);
    EXPECT_NEAR(meanOf(load["energy_j"]), 2 * 200e-6 * 25e-6 * 2000, 0.4e-6);
    EXPECT_GT(load["load_uncertainty_ohm"].get<double>(), 0);
    EXPECT_LT(load["load_uncertainty_ohm"].get<double>(), 20);
    EXPECT_THAT(desk.run({"measure", file}).out, HasSubstr("load: voltage over current, 4 pulses"));
}

TEST(MeasureLoad, AShuntMakesTheCurrent) {
    const Desk desk;
    const auto file = desk.write("shunt.csv", pulses("time_s,voltage_v,sense_v", 100));
    EXPECT_TRUE(jsonOf(desk.run({"measure", file, "--json"}))["load"].is_null()) << "two voltages are not a load";
    const auto ran = desk.run({"measure", file, "--channel", "sense", "--shunt", "100", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["load"]["pulses"], 4);
    EXPECT_NEAR(meanOf(value["load"]["load_ohm"]), 2000, 10);
}

TEST(MeasureLoad, TrustIsInTheJsonAndInTheText) {
    const Desk desk;
    const auto file = desk.write("pulses.csv", pulses("time_s,voltage_v,current_a", 1));
    const auto value = jsonOf(desk.run(stated({"measure", file, "--json"})));
    const auto& channel = value["channels"][0];
    expectKeys(channel["uncertainty"],
               {"coverage_factor", "amplitude", "width_s", "interval_s", "gap_s", "charge", "imbalance"},
               "uncertainty");
    EXPECT_EQ(channel["uncertainty"]["coverage_factor"], 2);
    EXPECT_NEAR(channel["uncertainty"]["amplitude"].get<double>(), 2 * channel["amplitude_uncertainty"].get<double>(),
                1e-9);
    EXPECT_NEAR(channel["quality"]["snr_db"].get<double>(), 54, 1);
    EXPECT_EQ(channel["quality"]["averaged"], 1);
    EXPECT_EQ(channel["quality"]["doubtful"], false);
    EXPECT_EQ(channel["flagged"]["under_sampled"], 0);
    EXPECT_EQ(channel["flagged"]["coarse"], 0);
    EXPECT_THAT(desk.run({"measure", file}).out, HasSubstr("uncertainty (k = 2): amplitude not known"));
    const auto silent = jsonOf(desk.run({"measure", file, "--json"}));
    EXPECT_TRUE(silent["channels"][0]["amplitude_uncertainty"].is_null()) << "it was not stated";
    EXPECT_THAT(silent["not_stated"].get<std::string>(), HasSubstr("the gain of voltage"));
    const auto refused = desk.run({"measure", file, "--accuracy", "gain=1"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--accuracy gain is not known; gain_pct"));
}

}  // namespace
}  // namespace tacto::test
