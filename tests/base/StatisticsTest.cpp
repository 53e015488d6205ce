#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "core/base/Statistics.h"

namespace tacto::test {
namespace {

TEST(Statistics, AgreesWithNumpy) {
    // x = [3.1, -2, 7.5, 0.25, 11]; np.mean, np.std(ddof=1), np.median
    const std::vector<double> readings{3.1, -2, 7.5, 0.25, 11};
    const auto s = statisticsOf(readings);
    EXPECT_EQ(s.n, 5U);
    EXPECT_NEAR(s.mean, 3.97, 1e-12);
    EXPECT_NEAR(s.sd, 5.294289376299713, 1e-12);
    EXPECT_EQ(s.median, 3.1);
    EXPECT_EQ(s.min, -2);
    EXPECT_EQ(s.max, 11);
}

TEST(Statistics, ALargeOffsetCostsNoDigits) {
    const std::vector<double> readings{1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4};
    const auto s = statisticsOf(readings);
    EXPECT_DOUBLE_EQ(s.mean, 1e9 + 2.5);
    EXPECT_DOUBLE_EQ(s.sd, std::sqrt(5.0 / 3.0));
    EXPECT_DOUBLE_EQ(s.median, 1e9 + 2.5);
}

TEST(Statistics, WhatDoesNotExistIsNotANumber) {
    RecordProperty("hazard", "H9");
    const auto none = statisticsOf({});
    EXPECT_EQ(none.n, 0U);
    EXPECT_TRUE(std::isnan(none.mean) && std::isnan(none.min) && std::isnan(none.sd) && std::isnan(none.median));
    const std::vector<double> one{4};
    EXPECT_EQ(statisticsOf(one).mean, 4);
    EXPECT_TRUE(std::isnan(statisticsOf(one).sd));
    const std::vector<double> spoiled{1, std::nan(""), 3};
    EXPECT_EQ(statisticsOf(spoiled).n, 3U);
    EXPECT_TRUE(std::isnan(statisticsOf(spoiled).mean) && std::isnan(statisticsOf(spoiled).max));
}

}  // namespace
}  // namespace tacto::test
