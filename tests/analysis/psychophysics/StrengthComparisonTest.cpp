#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "core/analysis/psychophysics/StrengthComparison.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

using testing::HasSubstr;

StrengthComparison between(double low, double high, std::uint64_t seed, double step = 0.5) {
    return StrengthComparison::create(test::gridUpTo(15, step), {.low = low, .high = high}, seed).value();
}

VirtualParticipant withWeber(double weber) {
    auto who = test::medianParticipant();
    who.amplitudeWeber = weber;
    return who;
}

StrengthComparisonResult answered(StrengthComparison comparison, const VirtualObserver& observer) {
    while (const auto trial = comparison.next()) {
        const auto key = "comparison " + std::to_string(trial->number);
        const auto said = observer.compare(key, trial->pair.weaker, trial->pair.stronger, trial->interval);
        EXPECT_TRUE(comparison.answer(said));
    }
    return comparison.result();
}

TEST(StrengthComparison, PairsLieInTheRangeAboutItsMiddle) {
    RecordProperty("hazard", "H6");
    for (const double high : {4.5, 6.0, 9.5}) {
        const auto pairs = between(4, high, 1).pairs();
        ASSERT_EQ(pairs.size(), static_cast<std::size_t>((high - 4) / 0.5)) << "one for each distance";
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            EXPECT_NEAR(pairs[i].stronger - pairs[i].weaker, 0.5 * static_cast<double>(i + 1), 1e-9);
            EXPECT_GE(pairs[i].weaker, 4);
            EXPECT_LE(pairs[i].stronger, high);
            EXPECT_LE(std::abs(std::log(pairs[i].weaker * pairs[i].stronger / (4 * high)) / 2), std::log(4.5 / 4) / 2)
                << "half a step beside the middle";
        }
    }
}

TEST(StrengthComparison, TheModelIsTheOneThatItSays) {
    // Φ at 0.5, 1 and 2 standard deviations; the difference of two has √2 times the standard deviation.
    for (const auto& [deviations, phi] :
         {std::pair(0.5, 0.6914624612740131), {1.0, 0.8413447460685429}, {2.0, 0.9772498680518208}}) {
        const StrengthPair pair{5, 5 * std::exp(deviations * std::sqrt(2) * std::log1p(0.1))};
        EXPECT_NEAR(StrengthComparison::probabilityRight(pair, 0.1), 0.5 + 0.48 * (2 * phi - 1), 1e-12);
    }
    EXPECT_EQ(StrengthComparison::probabilityRight({5, 5}, 0.1), 0.5);
}

TEST(StrengthComparison, AsksFortyTrialsWithTheWidestPairFirstAndNoPairFourTimesRunning) {
    auto comparison = between(4, 8, 7);
    const auto observer = test::observerFor(withWeber(0.1), 7);
    const auto result = answered(comparison, observer);
    ASSERT_EQ(result.trials.size(), 40U);
    EXPECT_EQ(result.intervals.first.trials, 20U);
    EXPECT_EQ(result.intervals.second.trials, 20U);
    const double widest = comparison.pairs().back().stronger;
    for (const std::size_t number : {1U, 8U, 16U, 24U, 32U, 40U})
        EXPECT_EQ(result.trials[number - 1].pair.stronger, widest) << number;
    for (std::size_t i = 3; i < result.trials.size(); ++i) {
        std::set<double> distances;
        for (std::size_t k = i - 3; k <= i; ++k)
            distances.insert(result.trials[k].pair.stronger - result.trials[k].pair.weaker);
        EXPECT_GT(distances.size(), 1U) << "trials to " << i + 1;
    }
    const auto again = answered(between(4, 8, 7), observer);
    EXPECT_EQ(again.weber.value, result.weber.value);
    EXPECT_FALSE(comparison.answer(static_cast<TrialInterval>(2)));
}

TEST(StrengthComparison, ARangeOfOnePairIsComparedAllTheSame) {
    const auto result = answered(between(4, 4.5, 3), test::observerFor(withWeber(0.1), 3));
    EXPECT_EQ(result.trials.size(), 40U);
    EXPECT_GT(result.weber.value, 0.03);
    EXPECT_LT(result.weber.value, 0.3);
}

TEST(StrengthComparison, WhoIsAlwaysRightOrGuessesIsAtTheEdgeOfWhatIsKnown) {
    auto always = between(4, 12, 1);
    while (const auto trial = always.next()) ASSERT_TRUE(always.answer(trial->interval));
    EXPECT_LT(always.result().weber.value, 0.05);
    auto first = between(4, 5, 1);
    while (first.next()) ASSERT_TRUE(first.answer(TrialInterval::First));
    EXPECT_GT(first.result().weber.value, 0.2) << "who says the same always tells nothing apart";
    EXPECT_EQ(first.result().intervals.first.right, 20U);
    EXPECT_EQ(first.result().intervals.second.right, 0U);
}

struct WeberRecovery {
    double bias = 0, sd = 0, cover = 0;  // errors of ln(estimate/truth), and share of intervals with the truth
};

/// `factor`: their Weber fraction relative to the one used for comparison.
WeberRecovery weberRecovery(std::size_t people, double weber, double factor = 1) {
    WeberRecovery out;
    double squares = 0;
    for (std::size_t i = 0; i < people; ++i) {
        const auto result = answered(between(4, 8, i), test::observerFor(withWeber(factor * weber), i));
        const double off = std::log(result.weber.value / weber);
        out.bias += off;
        squares += off * off;
        if (result.weber.low <= weber && weber <= result.weber.high) ++out.cover;
    }
    const auto n = static_cast<double>(people);
    out.bias /= n;
    out.sd = std::sqrt(squares / n - out.bias * out.bias);
    out.cover /= n;
    return out;
}

TEST(StrengthComparison, RecoversTheWeberFractionsOfVirtualParticipants) {
    const auto people = test::trials<std::size_t>({.local = 500, .ci = 2000, .campaign = 20'000});
    for (const double weber : {0.05, 0.10, 0.20}) {
        const auto found = weberRecovery(people, weber);
        std::printf("weber %.2f: bias %.3f, sd %.3f of ln, cover %.3f\n", weber, found.bias, found.sd, found.cover);
        EXPECT_LE(std::abs(found.bias), 0.2);
        EXPECT_LE(found.sd, 0.33);
        EXPECT_GE(found.cover, 0.9);
    }
    EXPECT_GT(weberRecovery(200, 0.10, 1.6).bias, 0.2) << "one that is too high is found";
    EXPECT_LT(weberRecovery(200, 0.10, 3).cover, 0.9);
}

TEST(StrengthComparison, WhatCannotBeComparedIsRefused) {
    const auto refusal = [](double low, double high, std::size_t trials = 40) {
        const auto made = StrengthComparison::create(test::gridUpTo(15), {low, high, trials}, 1);
        return made ? std::string() : made.error().message;
    };
    EXPECT_EQ(refusal(4, 4.5), "");
    EXPECT_THAT(refusal(4, 4), HasSubstr("between 4 and 4; two levels in steps of 0.5 mA"));
    EXPECT_THAT(refusal(4.1, 4.6), HasSubstr("between 4.1 and 4.6"));
    EXPECT_THAT(refusal(5, 4), HasSubstr("between 5 and 4"));
    EXPECT_THAT(refusal(0, 4), HasSubstr("between 0 and 4"));
    EXPECT_THAT(refusal(16, 17), HasSubstr("up to 15 mA"));
    EXPECT_THAT(refusal(std::nan(""), 4), HasSubstr("between nan and 4"));
    EXPECT_THAT(refusal(4, std::nan("")), HasSubstr("between 4 and nan"));
    EXPECT_THAT(refusal(4, 8, 0), HasSubstr("0 trials of comparison"));
    EXPECT_THAT(refusal(4, 8, 1001), HasSubstr("1001 trials"));
}

}  // namespace
}  // namespace tacto
