// analyze calibration: commanded and measured values from a CSV, compared with the formulas of science.md section 9.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

/// measured = 1.02 · commanded + 0.3, alternating ± `spread`, and ± `turn` by direction.
std::string csv(double spread, double turn) {
    std::string text = "commanded,measured,direction\n";
    for (const char* direction : {"up", "down"}) {
        for (int repeat = 0; repeat < 6; ++repeat) {
            for (int k = 0; k < 11; ++k) {
                const double command = 10 + 3.0 * k;
                const double aside = (repeat % 2 == 0 ? spread : -spread) + (direction[0] == 'u' ? -turn : turn);
                text += fmt::format("{:.17g},{:.17g},{}\n", command, 1.02 * command + 0.3 + aside, direction);
            }
        }
    }
    return text;
}

TEST(AnalyzeCalibration, FindsGainOffsetAndPercentagesOfTheLargestCommand) {
    const Desk desk;
    const auto ran = desk.run({"analyze", "calibration", desk.write("levels.csv", csv(0.05, 0.1)), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto found = nlohmann::json::parse(ran.out);
    EXPECT_NEAR(found.at("gain").get<double>(), 1.02, 1e-9);
    EXPECT_NEAR(found.at("offset").get<double>(), 0.3, 1e-9);
    EXPECT_NEAR(found.at("residual_max_pct_fs").get<double>(), 0, 1e-9);
    EXPECT_NEAR(found.at("repeatability_pct_fs").get<double>(), 100 * 0.05 * std::sqrt(6.0 / 5) / 40, 1e-9);
    EXPECT_NEAR(found.at("hysteresis_pct_fs").get<double>(), 100 * 0.2 / 40, 1e-9);
}

TEST(AnalyzeCalibration, WithoutDirectionsThereIsNoHysteresis) {
    const Desk desk;
    const auto ran = desk.run({"analyze", "calibration",
                               desk.write("levels.csv", "commanded,measured\n10,10.1\n20,20.1\n30,30.1\n"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto found = nlohmann::json::parse(ran.out);
    EXPECT_TRUE(found.at("hysteresis_pct_fs").is_null());
    EXPECT_NEAR(found.at("offset").get<double>(), 0.1, 1e-9);
}

TEST(AnalyzeCalibration, TextSaysTheSame) {
    const Desk desk;
    const auto ran = desk.run({"analyze", "calibration", desk.write("levels.csv", csv(0.05, 0.1))});
    EXPECT_EQ(ran.code, 0);
    for (const char* part : {"gain              1.02", "hysteresis        0.5 %", "repeatability     0.1369 %"}) {
        EXPECT_THAT(ran.out, testing::HasSubstr(part));
    }
}

TEST(AnalyzeCalibration, AFileThatIsNoCalibrationExitsThreeWithFileAndLine) {
    const Desk desk;
    const auto refused = [&](const std::string& text, const Words& parts) {
        expectRefused(desk.run({"analyze", "calibration", desk.write("bad.csv", text), "--json"}), 3, parts);
    };
    expectRefused(desk.run({"analyze", "calibration", desk.at("none.csv"), "--json"}), 3, {"none.csv"});
    refused("commanded,volts\n1,2\n", {"bad.csv:1", "measured"});
    refused("commanded,measured\n10,10\n20,x\n", {"bad.csv:3", "x", "number"});
    refused("commanded,measured,direction\n10,10,left\n", {"bad.csv:2", "left", "up, down"});
    refused("commanded,measured\n10,10\n10,11\n", {"bad.csv", "two"});
}

}  // namespace
}  // namespace tacto::test
