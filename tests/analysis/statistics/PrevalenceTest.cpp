#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/analysis/statistics/Prevalence.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

TEST(Prevalence, IntervalsAreTheShortestThatScipyFinds) {
    // 4 of 5: 38 to 98 %, pilot.md section 7; 5 of 5 at least 59 %, 3 of 3 at least 45 %, science.md section 11.
    for (const auto& scipy : test::figuresOf("identification").at("prevalence")) {
        const auto found = prevalenceInterval(scipy.at("k"), scipy.at("n"));
        EXPECT_NEAR(found.value, scipy.at("value").get<double>(), 1e-12) << scipy;
        EXPECT_NEAR(found.low, scipy.at("low").get<double>(), 1e-9) << scipy;
        EXPECT_NEAR(found.high, scipy.at("high").get<double>(), 1e-9) << scipy;
    }
}

// With k = n, θ^(n+1) is 0.05 of what lies between 0.05^(n+1) and 1.
TEST(Prevalence, OfAllIsThatOfInceAndOthers) {
    for (const std::size_t n : {1U, 4U, 12U}) {
        const double m = static_cast<double>(n + 1), cut = std::pow(0.05, m);
        const double theta = std::pow(cut + 0.05 * (1 - cut), 1 / m);
        EXPECT_NEAR(prevalenceInterval(n, n).low, (theta - 0.05) / 0.95, 1e-10) << n;
        EXPECT_EQ(prevalenceInterval(n, n).high, 1) << n;
    }
}

/// Posterior of the share in a thousand steps, from the binomial probability of k of n and nothing else.
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
    /// Probability between two shares.
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
            // As wide, and a little to either side, holds less.
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
}  // namespace tacto
