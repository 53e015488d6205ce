#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "core/analysis/identification/OverSessions.h"
#include "core/analysis/statistics/Estimate.h"
#include "tests/support/Figures.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

SessionFigures sessionOn(double days, std::size_t hits, Estimate detection = {}) {
    SessionFigures session;
    session.number = static_cast<std::size_t>(days) + 1;
    session.days = days;
    session.n = 80;
    session.hits = hits;
    session.detection = detection;
    return session;
}

TEST(OverSessions, TwoSessionsOf80At70PerCentShow14PerCent) {
    EXPECT_NEAR(smallestChange(80, 0.7), 0.142, 0.0005);
    EXPECT_TRUE(std::isnan(smallestChange(0, 0.7)));
    EXPECT_TRUE(std::isnan(smallestChange(80, 1))) << "all right: no change is not what it could show";
}

TEST(OverSessions, EachIsHeldAgainstTheFirst) {
    const auto found =
        test::accepted(compareSessions({sessionOn(0, 56, {2, 1.6, 2.5}), sessionOn(7, 68, {3, 2.7, 3.3})}));
    ASSERT_EQ(found.againstFirst.size(), 1U);
    const auto& change = found.againstFirst[0];
    EXPECT_NEAR(change.accuracy.value, 0.15, 1e-12);
    EXPECT_NEAR(change.detection.value, 1.5, 1e-12);
    EXPECT_NEAR(change.detection.low, 1.5 * std::exp(-std::hypot(std::log(3 / 2.7), std::log(2.5 / 2))), 1e-12);
    EXPECT_NEAR(change.detection.high, 1.5 * std::exp(std::hypot(std::log(3.3 / 3), std::log(2 / 1.6))), 1e-12);
    EXPECT_TRUE(std::isnan(change.impedance));
    EXPECT_TRUE(std::isnan(found.trend.value));  // a trend needs at least three sessions
    EXPECT_NEAR(found.smallestChange, smallestChange(80, 124.0 / 160), 1e-12);
}

Estimate estimateIn(const nlohmann::json& three) {
    return {three.at(0).get<double>(), three.at(1).get<double>(), three.at(2).get<double>()};
}

TEST(OverSessions, ARatioHasTheIntervalThatTheDistributionOfTwoEstimatesHas) {
    const auto& all = test::figuresOf("identification").at("ratios");
    ASSERT_GE(all.size(), 3U);
    for (const auto& scipy : all) {
        const auto ratio = ratioOf(estimateIn(scipy.at("a")), estimateIn(scipy.at("b")));
        EXPECT_NEAR(ratio.value, scipy.at("value").get<double>(), 1e-9);
        EXPECT_NEAR(ratio.low, scipy.at("low").get<double>(), 1e-9);
        EXPECT_NEAR(ratio.high, scipy.at("high").get<double>(), 1e-9);
    }
    EXPECT_TRUE(std::isnan(ratioOf({0, 0, 1}, {1, 0.5, 2}).value));
    EXPECT_TRUE(std::isnan(ratioOf({1, kNaN, kNaN}, {1, 0.5, 2}).low)) << "no interval is made up";
}

TEST(OverSessions, AFigureIsHeldAgainstTheFirstSessionThatHasIt) {
    auto first = sessionOn(0, 0);  // only thresholds
    first.n = 0;
    first.tooStrong = 8;
    auto second = sessionOn(2, 56, {2, 1.6, 2.5});
    second.high = 6;
    second.impedance = Ohms(3000);
    auto third = sessionOn(9, 64, {3, 2.7, 3.3});
    third.tooStrong = 10;
    third.high = 7.5;
    third.impedance = Ohms(3600);
    const auto found = test::accepted(compareSessions({first, second, third}));
    ASSERT_EQ(found.againstFirst.size(), 2U);
    EXPECT_TRUE(std::isnan(found.againstFirst[0].accuracy.value)) << "it is the first with test trials";
    EXPECT_TRUE(std::isnan(found.againstFirst[0].detection.value));
    const auto& change = found.againstFirst[1];
    EXPECT_NEAR(change.accuracy.value, 0.1, 1e-12);
    EXPECT_NEAR(change.detection.value, 1.5, 1e-12);
    EXPECT_NEAR(change.tooStrong, 1.25, 1e-12);
    EXPECT_NEAR(change.high, 1.25, 1e-12);
    EXPECT_NEAR(change.impedance, 1.2, 1e-12);
    EXPECT_TRUE(std::isnan(found.trend.value)) << "two have test trials";
    EXPECT_NEAR(found.smallestChange, smallestChange(80, 120.0 / 160), 1e-12);
}

TEST(OverSessions, ThreeHaveATrend) {
    const auto& scipy = test::figuresOf("identification").at("logistic")[0];
    const auto found = test::accepted(compareSessions({sessionOn(0, 50), sessionOn(3, 61), sessionOn(10, 70)}));
    EXPECT_NEAR(found.trend.value, scipy.at("value").get<double>(), 1e-8);
    EXPECT_NEAR(found.trend.low, scipy.at("low").get<double>(), 1e-7);
}

TEST(OverSessions, RefusesSessionsOutOfOrder) {
    EXPECT_EQ(compareSessions({sessionOn(7, 5), sessionOn(0, 5)}).error().message,
              "session 1 lies 0 days after the first; sessions in their order were expected");
    EXPECT_EQ(compareSessions({sessionOn(0, 81)}).error().message,
              "session 1 has 81 right answers of 80; at most 80 were expected");
    EXPECT_TRUE(compareSessions({}));
}

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

TEST(Encodings, TwoAlternate) {
    using Order = std::vector<std::size_t>;
    EXPECT_EQ(williamsOrder(2, 0), (Order{0, 1}));
    EXPECT_EQ(williamsOrder(2, 1), (Order{1, 0}));
    EXPECT_EQ(williamsOrder(2, 2), (Order{0, 1}));
    EXPECT_EQ(williamsOrder(1, 5), (Order{0}));
    EXPECT_TRUE(williamsOrder(0, 0).empty());
    EXPECT_EQ(williamsRows(3), 6U);
    EXPECT_EQ(williamsRows(4), 4U);
}

/// Each encoding occurs equally often in each place and after each other encoding.
TEST(Encodings, TheDesignIsBalanced) {
    for (const std::size_t n : {2U, 3U, 4U, 5U, 6U}) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> places, following;
        std::set<std::vector<std::size_t>> orders;
        for (std::size_t row = 0; row < williamsRows(n); ++row) {
            const auto order = williamsOrder(n, row);
            EXPECT_EQ(std::set(order.begin(), order.end()).size(), n);
            orders.insert(order);
            for (std::size_t i = 0; i < n; ++i) {
                ++places[{order[i], i}];
                if (i > 0) ++following[{order[i - 1], order[i]}];
            }
        }
        EXPECT_EQ(orders.size(), williamsRows(n)) << n;
        EXPECT_EQ(places.size(), n * n) << n;
        EXPECT_EQ(following.size(), n * (n - 1)) << n;
        for (const auto& [place, count] : places) EXPECT_EQ(count, williamsRows(n) / n) << n;
        for (const auto& [pair, count] : following) EXPECT_EQ(count, williamsRows(n) / n) << n;
    }
}

TEST(Encodings, PreferencesAreCountedWithThoseThatNobodyPrefers) {
    const EncodingPreference swapped{{"paper", "swapped"}, "swapped"}, notAsked{{"paper", "swapped"}};
    EXPECT_EQ(preferences(std::vector{swapped, swapped, notAsked}),
              (std::map<std::string, std::size_t>{{"paper", 0}, {"swapped", 2}}));
}

}  // namespace
}  // namespace tacto
