// What the bench writes of a weight on the fingertip is what its calibration reads.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using nlohmann::json;

TEST(WeightReading, IsWrittenAsItWasRead) {
    const json row{{"mass_g", 100},
                   {"reference_n", 0.98},
                   {"force", nullptr},
                   {"force_unit", "count"},
                   {"taxels", {1.5, nullptr, 3}},
                   {"taxel_unit", "Pa"},
                   {"force_in_use", {{"mean", 1.01}, {"unit", "N"}, {"u", 0.002}}}};
    const auto reading = test::accepted(weightReadingFrom(row));
    EXPECT_TRUE(std::isnan(reading.force));
    EXPECT_EQ(reading.forceUnit, StreamUnit::Count);
    ASSERT_EQ(reading.taxels.size(), 3U);
    EXPECT_TRUE(std::isnan(reading.taxels[1]));
    EXPECT_EQ(reading.inUse->mean, 1.01);
    EXPECT_EQ(toJson(reading), row);
}

TEST(WeightReading, AFingertipWithoutForceAndTaxelsStatesNoUnits) {
    const json row = toJson(WeightReading{.mass_g = 100, .reference_n = 0.98});
    EXPECT_FALSE(row.contains("force_unit"));
    EXPECT_FALSE(row.contains("taxel_unit"));
    EXPECT_TRUE(row.at("force").is_null());
    EXPECT_TRUE(row.at("force_in_use").is_null());
    EXPECT_EQ(row.at("taxels"), json::array());
}

TEST(WeightReading, RefusesOneWithoutItsWeightAndUnitsThatAFingertipDoesNotHave) {
    EXPECT_THAT(weightReadingFrom({{"force", 1}}),
                test::refused(ErrorCode::InvalidArgument, "\"reference_n\" is missing"));
    EXPECT_FALSE(weightReadingFrom({{"reference_n", 1}, {"force_unit", "kg"}}));
    EXPECT_FALSE(weightReadingFrom({{"reference_n", 1}, {"taxels", {"1"}}}));
}

}  // namespace
}  // namespace tacto
