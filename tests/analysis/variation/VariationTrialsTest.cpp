#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/statistics/Estimate.h"
#include "core/analysis/variation/VariationTrials.h"
#include "tests/analysis/statistics/CountedOut.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

/// Computed without the program's shortcuts: the probability of an outcome, from logarithms of factorials.
double chanceOf(std::size_t k, std::size_t n, double p) {
    const auto log = [](std::size_t x) { return std::lgamma(static_cast<double>(x) + 1); };
    const double a = static_cast<double>(k), b = static_cast<double>(n - k);
    return std::exp(log(n) - log(k) - log(n - k) + a * std::log(p) + b * std::log1p(-p));
}

template <class Holds>
double directly(std::span<const double> accuracies, std::size_t n, Holds&& holds) {
    double sum = 0;
    for (const double p : accuracies) {
        for (std::size_t k = 0; k <= n; ++k) {
            if (holds(wilsonInterval(k, n))) sum += chanceOf(k, n, p);
        }
    }
    return sum / static_cast<double>(accuracies.size());
}

TEST(VariationTrials, ProbabilitiesAreThoseOfEveryOutcomeCountedOut) {
    const std::vector<double> accuracies = {0.3, 0.55, 0.8, 0.97};
    for (const std::size_t n : {1U, 2U, 7U, 40U, 41U, 200U}) {
        for (const double width : {0.05, 0.1, 0.2, 0.5, 0.9}) {
            EXPECT_NEAR(widthReached(accuracies, n, width),
                        directly(accuracies, n, [&](Estimate e) { return e.high - e.low <= width; }), 1e-10)
                << n << " trials, width " << width;
        }
        for (const double chance : {0.1, 0.25, 0.5}) {
            EXPECT_NEAR(chanceExceeded(accuracies, n, chance),
                        directly(accuracies, n, [&](Estimate e) { return e.low > chance; }), 1e-10)
                << n << " trials, chance " << chance;
        }
    }
}

TEST(VariationTrials, TheSearchFindsWhatTryingEveryNumberFinds) {
    for (const double p : {0.35, 0.5, 0.8, 0.95}) {
        const double accuracies[] = {p};
        TrialsWanted wanted;
        wanted.width = 0.2;
        const auto found = trialsNeeded(accuracies, wanted).value();
        std::size_t forWidth = 0, aboveChance = 0;
        for (std::size_t n = 600; n >= 4; n -= 4) {
            if (directly(accuracies, n, [](Estimate e) { return e.high - e.low <= 0.2; }) < 0.8) break;
            forWidth = n;
        }
        for (std::size_t n = 600; n >= 4; n -= 4) {
            if (directly(accuracies, n, [](Estimate e) { return e.low > 0.25; }) < 0.8) break;
            aboveChance = n;
        }
        EXPECT_EQ(found.forWidth, forWidth) << p;
        EXPECT_EQ(found.aboveChance, aboveChance) << p;
        EXPECT_EQ(found.rho, 0);
        // All participants are alike, so pooled trials count like one participant's, up to whole blocks.
        ASSERT_TRUE(found.pooledForWidth.perParticipant);
        EXPECT_EQ(*found.pooledForWidth.total, 5 * *found.pooledForWidth.perParticipant);
        EXPECT_LE(*found.pooledForWidth.total, forWidth + 5 * 4);
        EXPECT_GT(*found.pooledForWidth.total + 4, forWidth);
        EXPECT_EQ(found.pooledForWidth.participantsLeast, 1U);
    }
}

TEST(VariationTrials, PeopleWhoDifferMakePooledTrialsCountLess) {
    std::vector<double> accuracies;
    for (int i = 0; i < 50; ++i) accuracies.push_back(i % 2 == 0 ? 0.5 : 0.9);
    TrialsWanted wanted;
    wanted.width = 0.2;
    wanted.participants = 40;
    const auto found = trialsNeeded(accuracies, wanted).value();
    EXPECT_NEAR(found.rho, 0.04 / (0.7 * 0.3), 1e-12);
    ASSERT_TRUE(found.pooledForWidth.perParticipant);
    const auto m = static_cast<double>(*found.pooledForWidth.perParticipant);
    EXPECT_NEAR(found.pooledForWidth.designEffect, 1 + (m - 1) * found.rho, 1e-12);
    // The effective number of trials is what one person with the mean accuracy needs; one block less is not enough.
    const double mean[] = {0.7};
    const double need = static_cast<double>(*trialsNeeded(mean, {0.2, 0.25, 0.8, 1}).value().forWidth);
    EXPECT_GE(40 * m / (1 + (m - 1) * found.rho), need);
    EXPECT_LT(40 * (m - 4) / (1 + (m - 5) * found.rho), need);
    // With fewer people no number of trials is enough, and the result says how many people are needed.
    wanted.participants = static_cast<std::size_t>(need * found.rho);
    const auto few = trialsNeeded(accuracies, wanted).value();
    EXPECT_FALSE(few.pooledForWidth.total);
    EXPECT_EQ(few.pooledForWidth.participantsLeast, wanted.participants + 1);
}

TEST(VariationTrials, NoNumberIsEnoughForThoseWhoGuess) {
    const double guessing[] = {0.25, 0.2, 0.25};
    const auto found = trialsNeeded(guessing, {}).value();
    EXPECT_FALSE(found.aboveChance);
    EXPECT_TRUE(found.forWidth);
}

TEST(VariationTrials, TheCurveHoldsTheQuantilesOfTheWidth) {
    const double accuracies[] = {0.8};
    const auto found = trialsNeeded(accuracies, {}).value();
    ASSERT_FALSE(found.curve.empty());
    for (const auto& point : found.curve) {
        // Widths up to the quantile have the required probability; widths just below it do not.
        EXPECT_GE(widthReached(accuracies, point.trials, point.width.value + 1e-12), 0.5 - 1e-9);
        EXPECT_LT(widthReached(accuracies, point.trials, point.width.value - 1e-9), 0.5 + 1e-9);
        EXPECT_LE(point.width.low, point.width.value);
        EXPECT_GE(point.width.high, point.width.value);
    }
    EXPECT_GT(found.curve.front().width.value, found.curve.back().width.value);
}

TEST(VariationTrials, RefusesWhatNoPilotCouldMean) {
    const double accuracies[] = {0.8};
    const double wrong[] = {1.2};
    const double unknown[] = {std::nan("")};
    EXPECT_FALSE(trialsNeeded({}, {}));
    EXPECT_FALSE(trialsNeeded(wrong, {}));
    EXPECT_FALSE(trialsNeeded(unknown, {}));
    for (const TrialsWanted& wanted :
         {TrialsWanted{0}, TrialsWanted{std::nan("")}, TrialsWanted{0.1, 1}, TrialsWanted{0.1, 0.25, 1},
          TrialsWanted{0.1, 0.25, 0.8, 0}, TrialsWanted{0.1, 0.25, 0.8, 4, 0}}) {
        EXPECT_THAT(trialsNeeded(accuracies, wanted), test::refused(ErrorCode::InvalidArgument));
    }
}

TEST(VariationPilot, SomeoneWhoIsNotServedShowsNothing) {
    const double accuracies[] = {0.9, 0.5, 0.3};
    const auto found = outlookOf({accuracies, 6}, 4, 40, 0.25);
    EXPECT_EQ(found.people, 4U);
    EXPECT_EQ(found.rightFrom, aboveChanceFrom(40, 0.25));
    EXPECT_NEAR(found.allServed, std::pow(0.5, 4), 1e-12);
    double one = 0;
    for (const double p : accuracies) one += test::countedOut(found.rightFrom, 40, p) / 6;
    EXPECT_NEAR(found.allAboveChance, std::pow(one, 4), 1e-10);
    EXPECT_GT(found.width.high, found.width.low);
}

}  // namespace
}  // namespace tacto
