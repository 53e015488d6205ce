// The data about a weight on the fingertip that scripts and the session receive.
#include <gtest/gtest.h>

#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"

namespace tacto {
namespace {

using nlohmann::json;

TEST(WeightReading, IsWrittenWithItsUnits) {
    const json expected{{"mass_g", 100.0},
                        {"reference_n", 0.98},
                        {"force", nullptr},
                        {"force_unit", "count"},
                        {"taxels", {1.5, nullptr, 3.0}},
                        {"taxel_unit", "Pa"},
                        {"force_in_use", {{"mean", 1.01}, {"unit", "N"}, {"u", 0.002}}}};
    EXPECT_EQ(toJson(WeightReading{.mass_g = 100,
                                   .reference_n = 0.98,
                                   .forceUnit = StreamUnit::Count,
                                   .taxels = {1.5, kNaN, 3},
                                   .taxelUnit = StreamUnit::Pascal,
                                   .inUse = ForceInUse{1.01, StreamUnit::Newton, 0.002}}),
              expected);
}

TEST(WeightReading, AFingertipWithoutForceAndTaxelsStatesNoUnits) {
    const json row = toJson(WeightReading{.mass_g = 100, .reference_n = 0.98});
    EXPECT_FALSE(row.contains("force_unit"));
    EXPECT_FALSE(row.contains("taxel_unit"));
    EXPECT_TRUE(row.at("force").is_null());
    EXPECT_TRUE(row.at("force_in_use").is_null());
    EXPECT_EQ(row.at("taxels"), json::array());
}

}  // namespace
}  // namespace tacto
