#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/identification/LogisticTrend.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

TEST(LogisticTrend, AgreesWithScipy) {
    for (const auto& scipy : test::figuresOf("identification").at("logistic")) {
        std::vector<LogisticPoint> points;
        for (const auto& point : scipy.at("points")) points.push_back({point[0], point[1], point[2]});
        const auto found = logisticSlope(points);
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-8) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-7) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-7) << scipy;
    }
}

TEST(LogisticTrend, OfWhatItCannotTellIsUnknown) {
    RecordProperty("hazard", "H9");
    for (const auto& points : {std::vector<LogisticPoint>{},
                               {{1, 16, 8}},
                               {{1, 16, 16}, {2, 16, 16}},
                               {{1, 16, 0}, {2, 16, 0}},
                               {{1, 16, 8}, {2, 0, 0}},
                               {{1, 8, 4}, {1, 8, 2}}})
        EXPECT_TRUE(std::isnan(logisticSlope(points).value));
}

TEST(LogisticTrend, ASlopeThatEveryAnswerAgreesWithIsOpen) {
    const std::vector<LogisticPoint> risen = {{1, 16, 0}, {2, 16, 16}};
    const auto found = logisticSlope(risen);
    EXPECT_EQ(found.value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(found.high, std::numeric_limits<double>::infinity());
    EXPECT_GT(found.low, 2);
    EXPECT_TRUE(std::isfinite(found.low));
    const std::vector<LogisticPoint> fallen = {{1, 16, 16}, {2, 16, 16}, {3, 16, 16}, {4, 16, 16}, {5, 16, 4}};
    EXPECT_EQ(logisticSlope(fallen).value, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(logisticSlope(fallen).low, -std::numeric_limits<double>::infinity());
    EXPECT_LT(logisticSlope(fallen).high, 0);
}

}  // namespace
}  // namespace tacto
