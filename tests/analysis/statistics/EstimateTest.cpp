#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/analysis/statistics/Estimate.h"
#include "core/base/JustNoticeable.h"
#include "tests/analysis/statistics/CountedOut.h"
#include "tests/support/Figures.h"

namespace tacto::test {
namespace {

TEST(Estimate, WilsonIntervalAgreesWithScipy) {
    for (const auto& scipy : figuresOf("estimates").at("wilson")) {
        const auto k = scipy.at("k").get<std::size_t>(), n = scipy.at("n").get<std::size_t>();
        const auto interval = wilsonInterval(k, n);
        EXPECT_DOUBLE_EQ(interval.value, static_cast<double>(k) / static_cast<double>(n));
        EXPECT_NEAR(interval.low, scipy.at("low").get<double>(), 1e-13) << k << "/" << n;
        EXPECT_NEAR(interval.high, scipy.at("high").get<double>(), 1e-13) << k << "/" << n;
    }
}

TEST(Estimate, NoTrialsKnowNothing) {
    RecordProperty("hazard", "H9");
    const auto interval = wilsonInterval(0, 0);
    EXPECT_TRUE(std::isnan(interval.value));
    EXPECT_EQ(interval.low, 0);
    EXPECT_EQ(interval.high, 1);
}

TEST(Estimate, JustNoticeableDifferencesCountWeberSteps) {
    EXPECT_NEAR(justNoticeableDifferences(10, 40, kAmplitudeWeberFraction), std::log(4) / std::log(1.1), 1e-12);
    EXPECT_NEAR(justNoticeableDifferences(2, 0.5, kIntervalWeberFraction), std::log(4) / std::log(1.16), 1e-12);
    EXPECT_NEAR(justNoticeableDifferences(10, 11, 0.10), 1, 1e-12);
    EXPECT_EQ(justNoticeableDifferences(7, 7, 0.10), 0);
}

TEST(Estimate, JustNoticeableDifferencesOfWhatIsNotMeasuredAreUnknown) {
    RecordProperty("hazard", "H9");
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(bad, 1, 0.1))) << bad;
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(1, bad, 0.1))) << bad;
        EXPECT_TRUE(std::isnan(justNoticeableDifferences(1, 2, bad))) << bad;
    }
}

TEST(Binomial, AboveChanceIsTheExactTest) {
    for (const std::size_t n : {4U, 20U, 80U, 100U}) {
        const auto from = aboveChanceFrom(n, 0.25);
        EXPECT_LE(test::countedOut(from, n, 0.25), 0.05) << n;
        EXPECT_GT(test::countedOut(from - 1, n, 0.25), 0.05) << n;
    }
    // 27 of 80, as in science.md section 11. For one trial it is 2: one answer is never enough.
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

TEST(Prevalence, IntervalsAreTheShortestThatScipyFinds) {
    // 4 of 5: 38 to 98 % (pilot.md section 7). 5 of 5: at least 59 %; 3 of 3: at least 45 % (science.md section 11).
    for (const auto& scipy : test::figuresOf("identification").at("prevalence")) {
        const auto found = prevalenceInterval(scipy.at("k"), scipy.at("n"));
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-12) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-9) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-9) << scipy;
    }
}

// If k = n, θ^(n+1) is 5 % of the way from 0.05^(n+1) to 1.
TEST(Prevalence, OfAllIsThatOfInceAndOthers) {
    for (const std::size_t n : {1U, 4U, 12U}) {
        const double m = static_cast<double>(n + 1), cut = std::pow(0.05, m);
        const double theta = std::pow(cut + 0.05 * (1 - cut), 1 / m);
        EXPECT_NEAR(prevalenceInterval(n, n).low, (theta - 0.05) / 0.95, 1e-10) << n;
        EXPECT_EQ(prevalenceInterval(n, n).high, 1) << n;
    }
}

/// The posterior of the share in a thousand steps, computed only from the binomial probability of k of n.
class Posterior {
public:
    Posterior(std::size_t k, std::size_t n) {
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double theta = 0.05 + 0.95 * (i + 0.5) / kSteps;
            density_.push_back(
                std::exp(static_cast<double>(k) * std::log(theta) + static_cast<double>(n - k) * std::log1p(-theta)));
            sum += density_.back();
        }
        for (double& part : density_) part /= sum;
    }
    /// Returns the probability between two shares.
    [[nodiscard]] double between(double low, double high) const {
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double from = std::max(low, 1.0 * i / kSteps), to = std::min(high, (i + 1.0) / kSteps);
            if (to > from) sum += density_[static_cast<std::size_t>(i)] * (to - from) * kSteps;
        }
        return sum;
    }

private:
    static constexpr int kSteps = 20'000;
    std::vector<double> density_;
};

TEST(Prevalence, EveryCountUpToTwentyHas95PercentInNoMoreThanItNeeds) {
    RecordProperty("hazard", "H9");
    for (std::size_t n = 1; n <= 20; ++n) {
        double before = 0;
        for (std::size_t k = 0; k <= n; ++k) {
            const auto found = prevalenceInterval(k, n);
            const Posterior truth(k, n);
            EXPECT_NEAR(truth.between(found.low, found.high), 0.95, 1e-5) << k << " of " << n;
            EXPECT_GE(found.value, found.low) << k << " of " << n;
            EXPECT_LE(found.value, found.high) << k << " of " << n;
            EXPECT_GE(found.low, before) << k << " of " << n;
            before = found.low;
            // An interval of the same width, shifted slightly to either side, contains less probability.
            constexpr double kAside = 1e-3;
            if (found.low >= kAside) {
                EXPECT_LE(truth.between(found.low - kAside, found.high - kAside), 0.95) << k << " of " << n;
            }
            if (found.high <= 1 - kAside) {
                EXPECT_LE(truth.between(found.low + kAside, found.high + kAside), 0.95) << k << " of " << n;
            }
        }
        EXPECT_EQ(prevalenceInterval(0, n).low, 0) << "none of " << n << " above chance";
    }
}

}  // namespace
}  // namespace tacto::test
