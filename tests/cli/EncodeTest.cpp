// encode: the numbers of science.md section 4, and the decision of the gate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

Ran encode(const std::string& roughness, const std::string& pressure, const std::string& load) {
    const Desk desk;
    return desk.run({"encode", "--roughness", roughness, "--pressure-pa", pressure, "--load", load, "--json"});
}

void expectTrain(const Ran& ran, double volts, double milliamps, double seconds) {
    const auto value = jsonOf(ran);
    expectKeys(value, {"amplitude_v", "amplitude_ma", "interval_s", "approved", "refusal"}, "encode");
    EXPECT_NEAR(value["amplitude_v"].get<double>(), volts, 1e-9);
    EXPECT_NEAR(value["amplitude_ma"].get<double>(), milliamps, 1e-9);
    EXPECT_NEAR(value["interval_s"].get<double>(), seconds, 1e-9);
}

TEST(Encode, FullRoughnessAndPressureInto500OhmIs40VoltsEveryHalfSecond) {
    const auto ran = encode("1", "60000", "500");
    EXPECT_EQ(ran.code, 0);
    expectTrain(ran, 40, 80, 0.5);
    EXPECT_EQ(jsonOf(ran)["approved"], true);
    EXPECT_TRUE(jsonOf(ran)["refusal"].is_null());
}

TEST(Encode, TheSameInto100OhmIsRefusedWithTheLimitNamed) {
    RecordProperty("hazard", "H1");
    const auto ran = encode("1", "60000", "100");
    EXPECT_EQ(ran.code, 4);
    expectTrain(ran, 40, 400, 0.5);
    EXPECT_EQ(jsonOf(ran)["approved"], false);
    // 40 V over 400 us twice a second: 11.3 mA RMS into 100 ohm, 14.1 mA into its lower end, 80 ohm. With amplitude and
    // width 5 % larger and the interval 5 % shorter (11 trains in 5 s): 16.0 mA.
    EXPECT_THAT(jsonOf(ran)["refusal"].get<std::string>(),
                testing::AllOf(testing::HasSubstr("15.96"), testing::HasSubstr("10 mA"), testing::HasSubstr("RMS")));
}

TEST(Encode, TheMiddleIsLinearAndTheEndsAreTheNominalRanges) {
    expectTrain(encode("0.5", "26000", "1000"), 25, 25, 1.25);
    expectTrain(encode("0", "0", "1000"), 10, 10, 2.0);
    expectTrain(encode("0", "2000", "10000"), 10, 1, 2.0);
    expectTrain(encode("1", "50000", "1000"), 40, 40, 0.5);
}

TEST(Encode, WhatIsNotARoughnessAPressureOrALoadIsRefused) {
    expectRefused(encode("1.1", "60000", "500"), 2, {"roughness", "1.1", "0 to 1"});
    expectRefused(encode("nan", "60000", "500"), 2, {"roughness", "nan"});
    expectRefused(encode("1", "-5", "500"), 2, {"pressure", "-5"});
    expectRefused(encode("1", "inf", "500"), 2, {"pressure", "inf"});
    expectRefused(encode("1", "60000", "0"), 2, {"load", "0"});
    expectRefused(encode("1", "60000", "-500"), 2, {"load", "-500"});
    const Desk desk;
    expectRefused(desk.run({"encode", "--roughness", "1", "--load", "500"}), 2, {"pressure-pa"});
}

TEST(Encode, AProfileThatCannotBeReadExitsThree) {
    const Desk desk;
    const Words words{"encode", "--roughness", "1", "--pressure-pa", "60000", "--load", "500", "--profile"};
    auto missing = words;
    missing.push_back(desk.at("none.json"));
    expectRefused(desk.run(missing), 3, {"none.json"});
    auto broken = words;
    broken.push_back(desk.write("broken.json", "{ amplitude"));
    expectRefused(desk.run(broken), 3, {"broken.json", "JSON"});
}

TEST(Encode, TextSaysTheSame) {
    const Desk desk;
    const auto ran = desk.run({"encode", "--roughness", "1", "--pressure-pa", "60000", "--load", "100"});
    EXPECT_EQ(ran.code, 4);
    EXPECT_THAT(ran.out, testing::HasSubstr("40.00 V"));
    EXPECT_THAT(ran.out, testing::HasSubstr("15.96"));
}

}  // namespace
}  // namespace tacto::test
