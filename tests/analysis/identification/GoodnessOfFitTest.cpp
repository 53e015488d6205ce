#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/identification/GoodnessOfFit.h"
#include "core/base/Random.h"
#include "tests/support/Figures.h"

namespace tacto {
namespace {

using Counts = std::vector<std::vector<std::size_t>>;
using Shares = std::vector<std::vector<double>>;

TEST(GoodnessOfFit, AgreesWithEveryTableCountedOut) {
    const auto& exact = test::figuresOf("identification").at("fit");
    const auto found = goodnessOfFit(exact.at("counts").get<Counts>(), exact.at("predicted").get<Shares>(),
                                     {.draws = 200'000, .seed = 7});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->g, exact.at("g").get<double>(), 1e-12);
    const double larger = exact.at("p_larger"), equal = exact.at("p_equal");
    EXPECT_GE(found->p, larger - 0.005);
    EXPECT_LE(found->p, larger + equal + 0.005);
}

/// What the model itself answers has a p that is even, also where nearly all of it is right.
TEST(GoodnessOfFit, IsEvenWhereTheModelHolds) {
    const Shares model = {{0.97, 0.01, 0.01, 0.01}, {0.02, 0.95, 0.02, 0.01}, {0.3, 0.1, 0.5, 0.1}};
    constexpr std::size_t kSeeds = 400, kTrials = 20;
    std::vector<double> found;
    for (std::size_t seed = 0; seed < kSeeds; ++seed) {
        Random random(seed, "answers");
        Counts counts(model.size(), std::vector<std::size_t>(4, 0));
        for (std::size_t i = 0; i < model.size(); ++i) {
            for (std::size_t trial = 0; trial < kTrials; ++trial) {
                double left = random.uniform();
                std::size_t j = 0;
                while (j < 3 && left >= model[i][j]) left -= model[i][j++];
                ++counts[i][j];
            }
        }
        found.push_back(goodnessOfFit(counts, model, {.draws = 1000, .seed = seed})->p);
    }
    std::ranges::sort(found);
    double distance = 0;  // of Kolmogorov and Smirnov
    for (std::size_t i = 0; i < kSeeds; ++i) {
        const double below = static_cast<double>(i) / kSeeds, above = static_cast<double>(i + 1) / kSeeds;
        distance = std::max({distance, found[i] - below, above - found[i]});
    }
    // One in a thousand of a right program lies beyond 1.95/√n, and the seeds are fixed.
    EXPECT_LT(distance, 1.95 / std::sqrt(kSeeds));
}

TEST(GoodnessOfFit, FindsAnotherModel) {
    const Counts counts = {{10, 10}, {10, 10}};
    EXPECT_LT(goodnessOfFit(counts, Shares{{0.9, 0.1}, {0.1, 0.9}})->p, 0.001);
    EXPECT_GT(goodnessOfFit(counts, Shares{{0.5, 0.5}, {0.5, 0.5}})->p, 0.5);
}

TEST(GoodnessOfFit, AnAnswerThatTheModelExcludesHasNoProbability) {
    const auto found = goodnessOfFit(Counts{{19, 1}}, Shares{{1, 0}});
    ASSERT_TRUE(found);
    EXPECT_TRUE(std::isinf(found->g));
    EXPECT_EQ(found->p, 0);
}

TEST(GoodnessOfFit, RefusesWhatIsNoPrediction) {
    const auto refusal = [](const Counts& counts, const Shares& shares, FitOptions options = {}) {
        const auto found = goodnessOfFit(counts, shares, options);
        return found ? std::string("accepted") : found.error().message;
    };
    EXPECT_EQ(refusal({{1, 2}}, {}), "1 rows of counts and 0 of predictions; as many were expected");
    EXPECT_EQ(refusal({{1, 2}}, {{1}}), "row 1 has 2 counts and 1 predictions; as many were expected");
    EXPECT_EQ(refusal({{1, 2}}, {{0.5, 0.4}}), "the probabilities of row 1 sum to 0.9; 1 was expected");
    EXPECT_EQ(refusal({{1, 2}}, {{1, std::nan("")}}), "row 1 predicts a probability of nan; 0 to 1 is accepted");
    EXPECT_EQ(refusal({{1, 2}}, {{0.5, 0.5}}, {.draws = 10}), "10 draws; at least 1000 were expected");
}

}  // namespace
}  // namespace tacto
