#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/statistics/Binomial.h"
#include "tests/analysis/statistics/CountedOut.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

TEST(Binomial, AboveChanceIsTheExactTest) {
    for (const std::size_t n : {4U, 20U, 80U, 100U}) {
        const auto from = aboveChanceFrom(n, 0.25);
        EXPECT_LE(test::countedOut(from, n, 0.25), 0.05) << n;
        EXPECT_GT(test::countedOut(from - 1, n, 0.25), 0.05) << n;
    }
    // 27 of 80, as science.md section 11 says; 2 of 1: one answer is never enough.
    for (const auto& scipy : test::figuresOf("estimates").at("above_chance"))
        EXPECT_EQ(aboveChanceFrom(scipy.at("n"), scipy.at("chance")), scipy.at("from").get<std::size_t>()) << scipy;
}

TEST(Binomial, ExactIntervalsAgreeWithScipy) {
    for (const auto& scipy : test::figuresOf("identification").at("exact")) {
        const auto found = clopperPearsonInterval(scipy.at("k"), scipy.at("n"));
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-12) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-10) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-10) << scipy;
    }
    EXPECT_NEAR(clopperPearsonInterval(0, 10).high, 0.31, 0.005);  // pilot.md section 7
}

TEST(Binomial, DifferencesAreThoseOfNewcombe) {
    for (const auto& scipy : test::figuresOf("identification").at("newcombe")) {
        const auto found = newcombeDifference(scipy.at("a"), scipy.at("m"), scipy.at("b"), scipy.at("n"));
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-12) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-10) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-10) << scipy;
    }
    // Newcombe 1998, table II, cases (a), (c) and (e).
    const struct {
        std::size_t a, m, b, n;
        double low, high;
    } published[] = {{56, 70, 48, 80, 0.0524, 0.3339}, {6, 7, 2, 7, 0.0582, 0.8062}, {0, 10, 0, 20, -0.1611, 0.2775}};
    for (const auto& one : published) {
        const auto found = newcombeDifference(one.a, one.m, one.b, one.n);
        EXPECT_NEAR(found.low, one.low, 5e-5) << one.a << "/" << one.m;
        EXPECT_NEAR(found.high, one.high, 5e-5) << one.a << "/" << one.m;
    }
    EXPECT_TRUE(std::isnan(newcombeDifference(0, 0, 3, 5).low));
}

TEST(Binomial, WithoutTrialsNothingIsKnown) {
    RecordProperty("hazard", "H9");
    const auto found = clopperPearsonInterval(0, 0);
    EXPECT_TRUE(std::isnan(found.value));
    EXPECT_EQ(found.low, 0);
    EXPECT_EQ(found.high, 1);
}

}  // namespace
}  // namespace tacto
