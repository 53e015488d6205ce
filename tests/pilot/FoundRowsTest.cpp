#include <gtest/gtest.h>

#include "core/pilot/FoundRows.h"

namespace tacto {
namespace {

using nlohmann::json;

TEST(FoundRows, ARangeIsReadAsItWasWrittenInItsUnit) {
    const RangeRow current{.usable = true,
                           .min = 4,
                           .max = 6.5,
                           .jnd = 5.1,
                           .limitedBy = LevelLimit::Cap,
                           .minVoltage = Volts(14),
                           .maxVoltage = Volts(22),
                           .impedance = Ohms(3400)};
    const auto body = toJson(current);
    EXPECT_EQ(body, json({{"usable", true},
                          {"reason", nullptr},
                          {"min_ma", 4.0},
                          {"max_ma", 6.5},
                          {"jnd", 5.1},
                          {"limited_by", "cap"},
                          {"min_v", 14.0},
                          {"max_v", 22.0},
                          {"impedance_ohm", 3400.0}}));
    EXPECT_EQ(toJson(rangeRowFrom(body)), body);

    const auto none = toJson(RangeRow{.unit = LevelUnit::Intensity, .reason = "no room"});
    EXPECT_EQ(none, json({{"usable", false},
                          {"reason", "no room"},
                          {"min_intensity", nullptr},
                          {"max_intensity", nullptr},
                          {"jnd", nullptr},
                          {"limited_by", "too-strong"}}));
    const auto read = rangeRowFrom(none);
    EXPECT_EQ(read.unit, LevelUnit::Intensity);
    EXPECT_EQ(toJson(read), none);
}

TEST(FoundRows, ADriftIsReadAsItWasWrittenInItsUnit) {
    for (const auto unit : {LevelUnit::Current, LevelUnit::Intensity}) {
        const auto body = toJson(DriftRow{
            .unit = unit, .block = 3, .detection = {2.5, 2.1, 2.9}, .probability = 0.9, .rests = 2, .adapted = true});
        EXPECT_EQ(body, json({{"block", 3},
                              {levelKey("detection", unit), {{"value", 2.5}, {"low", 2.1}, {"high", 2.9}}},
                              {"probability", 0.9},
                              {"rests", 2},
                              {"adapted", true}}));
        EXPECT_EQ(toJson(driftRowFrom(body)), body);
    }
}

TEST(FoundRows, WhatCannotBeReadIsUnknownAndNeverZero) {
    RecordProperty("hazard", "H8");
    for (const auto& body : {json(), json(7), json::array({1}), json::object(),
                             json({{"min_ma", "4"}, {"usable", 1}, {"seed", -1}, {"detection_ma", {1}}})}) {
        EXPECT_TRUE(std::isnan(rangeRowFrom(body).min)) << body;
        EXPECT_FALSE(rangeRowFrom(body).usable) << body;
        EXPECT_TRUE(std::isnan(driftRowFrom(body).detection.value)) << body;
        EXPECT_EQ(planRowFrom(body).blocks, 0U) << body;
    }
    EXPECT_EQ(planRowFrom({{"name", "plan"}, {"seed", 18446744073709551615U}, {"blocks", 5}, {"trials", nullptr}}).seed,
              18446744073709551615U);
}

}  // namespace
}  // namespace tacto
