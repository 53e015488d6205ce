#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/Random.h"
#include "core/base/Statistics.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

TEST(Statistics, AgreesWithNumpy) {
    const auto& numpy = figuresOf("estimates").at("sample");
    const auto s = statisticsOf(numpy.at("readings").get<std::vector<double>>());
    EXPECT_EQ(s.n, 5U);
    EXPECT_NEAR(s.mean, numpy.at("mean").get<double>(), 1e-12);
    EXPECT_NEAR(s.sd, numpy.at("sd").get<double>(), 1e-12);
    EXPECT_EQ(s.median, numpy.at("median").get<double>());
    EXPECT_EQ(s.min, -2);
    EXPECT_EQ(s.max, 11);
}

TEST(Statistics, TheMedianOfManyReadingsIsTheMiddleOfTheSorted) {
    Random random(1, "median");
    const auto expectMiddle = [](const std::vector<double>& readings, const char* what) {
        auto sorted = readings;
        std::sort(sorted.begin(), sorted.end());
        const std::size_t n = sorted.size();
        EXPECT_EQ(statisticsOf(readings).median, 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])) << what << ", " << n;
    };
    for (const std::size_t n : {100U, 101U, 8192U, 8193U, 50'000U, 50'001U, 200'000U}) {
        std::vector<double> noise(n), ramp(n), steps(n), periodic(n), halves(n);
        for (std::size_t k = 0; k < n; ++k) {
            noise[k] = random.normal();
            ramp[k] = static_cast<double>(n - k);
            steps[k] = static_cast<double>(random.below(3));
            periodic[k] = k % (n / 1024 + 1) == 0 || k % std::max<std::size_t>(1, n / 1024) == 0 ? 1000 : noise[k];
            halves[k] = (k < n / 2 ? -1 : 1) * (1 + random.uniform());
        }
        expectMiddle(noise, "noise");
        expectMiddle(ramp, "a ramp");
        expectMiddle(steps, "many equal readings");
        expectMiddle(periodic, "outliers in step with the readings that are asked");
        expectMiddle(halves, "none near the middle");
    }
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
