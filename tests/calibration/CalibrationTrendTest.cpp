// Changes of a stimulator between calibrations: which exceed the uncertainties, and which cannot be judged.
#include <cmath>
#include <gtest/gtest.h>

#include "core/calibration/CalibrationTrend.h"

namespace tacto::test {
namespace {

StoredCalibration made(const char* day, double gain, double offset = 0, double u_pct = 1) {
    StoredCalibration c;
    c.serial = "A1";
    c.unit = "V";
    c.amplitude = {{gain, offset, 10, 40}, u_pct};
    c.interval = {{1, 0, 0.5, 2}, 0.01};
    c.made = parseDate(day).value();
    return c;
}

std::vector<TrendPoint> amplitude(std::vector<StoredCalibration> all) { return trendOf(all, "V", false, "amplitude"); }

TEST(CalibrationTrend, StandsInTheOrderOfItsDays) {
    const auto points = amplitude({made("2026-05-01", 1.01), made("2025-05-01", 1.00), made("2026-05-01", 1.02)});
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].gain, 1.00);
    EXPECT_EQ(points[1].gain, 1.01) << "of one day, as they were stored";
    EXPECT_EQ(points[2].gain, 1.02);
}

TEST(CalibrationTrend, GainIsKnownToUAndOffsetToUOfTheLowestCommand) {
    const auto points = amplitude({made("2026-05-01", 1.01, -0.05, 0.8)});
    EXPECT_DOUBLE_EQ(points[0].gainU, 0.008);
    EXPECT_DOUBLE_EQ(points[0].offsetU, 0.08);
}

TEST(CalibrationTrend, OtherUnitsSimulationAndMissingQuantitiesArePassedOver) {
    RecordProperty("hazard", "H9");
    auto current = made("2026-05-01", 1), simulated = made("2026-05-01", 1);
    current.unit = "mA";
    simulated.simulated = true;
    const std::vector<StoredCalibration> all{current, simulated, made("2026-05-02", 1)};
    EXPECT_EQ(trendOf(all, "V", false, "amplitude").size(), 1U);
    EXPECT_EQ(trendOf(all, "V", true, "amplitude").size(), 1U);
    EXPECT_EQ(trendOf(all, "V", false, "interval").size(), 1U);
    EXPECT_TRUE(trendOf(all, "V", false, "width").empty()) << "its line is not there";
    EXPECT_TRUE(trendOf(all, "V", false, "colour").empty());
}

TEST(CalibrationTrend, AJumpIsMoreThanBothUTogether) {
    // U of 1 % each: 1.414 % for the difference.
    EXPECT_TRUE(jumpsIn(amplitude({made("2025-05-01", 1.000), made("2026-05-01", 1.014)})).empty());
    const auto jumps = jumpsIn(amplitude({made("2025-05-01", 1.000), made("2026-05-01", 0.985)}));
    ASSERT_EQ(jumps.size(), 1U);
    EXPECT_EQ(jumps[0].what, TrendJump::What::Gain);
    EXPECT_NEAR(jumps[0].change, -0.015, 1e-12);
    EXPECT_NEAR(jumps[0].explained, 0.01 * std::sqrt(2.0), 1e-12);
    EXPECT_EQ(dateText(jumps[0].from), "2025-05-01");
    EXPECT_EQ(dateText(jumps[0].to), "2026-05-01");
}

TEST(CalibrationTrend, OffsetsJumpToo) {
    const auto jumps = jumpsIn(amplitude({made("2025-05-01", 1, 0), made("2026-05-01", 1, 0.15)}));
    ASSERT_EQ(jumps.size(), 1U);
    EXPECT_EQ(jumps[0].what, TrendJump::What::Offset);
    EXPECT_NEAR(jumps[0].explained, 0.1 * std::sqrt(2.0), 1e-12);
}

TEST(CalibrationTrend, WhatHasNoUIsNotJudged) {
    RecordProperty("hazard", "H9");
    const auto points = amplitude({made("2025-05-01", 1, 0, 0), made("2026-05-01", 2, 5)});
    EXPECT_TRUE(std::isnan(points[0].gainU)) << "0 is unknown, not perfect";
    EXPECT_TRUE(jumpsIn(points).empty());
}

}  // namespace
}  // namespace tacto::test
