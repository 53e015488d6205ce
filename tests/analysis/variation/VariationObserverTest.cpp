#include <gtest/gtest.h>
#include <numbers>

#include "core/analysis/variation/VariationObserver.h"

namespace tacto {
namespace {

double phi(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

IdentificationTask taskOf(std::vector<FeltPoint> points) {
    IdentificationTask task;
    task.given.assign(points.size(), true);
    task.points = std::move(points);
    return task;
}

/// Returns the paper's four conditions, in just-noticeable differences of the default Weber fractions, times `scale`.
IdentificationTask fourConditions(double scale) {
    const double a = scale * std::log(4) / std::log(1.10), t = scale * std::log(4) / std::log(1.16);
    return taskOf({{0, t}, {0, 0}, {a, t}, {a, 0}});
}

TEST(VariationObserver, TwoConditionsAlongOneDimensionFollowTheClosedForm) {
    for (const double d : {0.0, 0.5, 1.0, 2.0, 4.0}) {
        for (const double sigma : {0.5, 1.0, 3.0}) {
            const double expected = phi(d / (2 * sigma));
            for (const auto& task : {taskOf({{20, 3}, {20 + d, 3}}), taskOf({{20, 3}, {20, 3 + d}})}) {
                const auto p = responseProbabilities(task, {sigma});
                const double right = d == 0 ? 1 : expected;  // of equal points, the first is the answer
                EXPECT_NEAR(p[0][0], right, 1e-9) << d << " " << sigma;
                EXPECT_NEAR(p[1][1], d == 0 ? 0 : expected, 1e-9) << d << " " << sigma;
            }
        }
    }
}

TEST(VariationObserver, ARectangleOfFourIsTheProductOfItsSides) {
    const auto task = fourConditions(0.1);
    const double a = task.points[2].amplitude_jnd, t = task.points[0].interval_jnd;
    const auto p = responseProbabilities(task, {1.0});
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(p[i][i], phi(a / 2) * phi(t / 2), 1e-9);
        EXPECT_NEAR(p[i][i ^ 1U], phi(a / 2) * phi(-t / 2), 1e-9);
        EXPECT_NEAR(p[i][i ^ 2U], phi(-a / 2) * phi(t / 2), 1e-9);
        EXPECT_NEAR(p[i][i ^ 3U], phi(-a / 2) * phi(-t / 2), 1e-9);
        EXPECT_EQ(p[i][4], 0);
    }
}

TEST(VariationObserver, EveryRowIsAProbabilityForPointsThatAreNoRectangle) {
    Random random(3, "points");
    for (int round = 0; round < 50; ++round) {
        std::vector<FeltPoint> points;
        for (int i = 0; i < 5; ++i) points.push_back({10 * random.uniform(), 10 * random.uniform()});
        auto task = taskOf(points);
        task.given[3] = round % 2 == 0;
        for (const auto guess : {GuessBehaviour::None, GuessBehaviour::Uniform}) {
            const auto p = responseProbabilities(task, {1.5, 0.1, 4.0, guess});
            for (std::size_t i = 0; i < points.size(); ++i) {
                double sum = 0;
                for (const double one : p[i]) {
                    EXPECT_GE(one, 0);
                    sum += one;
                }
                EXPECT_NEAR(sum, task.given[i] ? 1 : 0, 1e-8) << "round " << round;
            }
        }
    }
}

TEST(VariationObserver, LapsesAndGuessesSpreadEvenly) {
    const auto task = fourConditions(1);
    const double a = task.points[2].amplitude_jnd / 2, t = task.points[0].interval_jnd / 2;
    const auto p = responseProbabilities(task, {1.0, 0.2});
    EXPECT_NEAR(p[0][0], 0.8 * phi(a) * phi(t) + 0.2 / 4, 1e-9);
    EXPECT_NEAR(p[0][3], 0.8 * phi(-a) * phi(-t) + 0.2 / 4, 1e-9);

    Observer numb{1.0, 0.0, 1.0};  // feels amplitude 0 with P = phi(-1)
    EXPECT_NEAR(responseProbabilities(task, numb)[0][4], phi(1), 1e-9);
    EXPECT_NEAR(responseProbabilities(task, numb)[2][4], 0, 1e-9);
    numb.guess = GuessBehaviour::Uniform;
    EXPECT_NEAR(responseProbabilities(task, numb)[0][4], 0, 1e-12);
    EXPECT_NEAR(responseProbabilities(task, numb)[0][0], phi(-1) + phi(1) / 4, 1e-5);
}

TEST(VariationObserver, SampledAnswersAgreeWithTheProbabilities) {
    auto task = fourConditions(0.15);
    task.given[1] = false;
    const Observer observer{1.0, 0.08, -0.5, GuessBehaviour::None};
    const auto p = responseProbabilities(task, observer);
    constexpr std::size_t kTrials = 20'000;
    Random random(11, "answers");
    const auto counts = sampleResponses(task, observer, kTrials, random);
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t sum = 0;
        for (std::size_t j = 0; j < 5; ++j) {
            sum += counts[i][j];
            const double expected = kTrials * p[i][j];
            // Five standard deviations: a correct program fails once in two million, and the seed is fixed.
            EXPECT_NEAR(static_cast<double>(counts[i][j]), expected, 5 * std::sqrt(expected * (1 - p[i][j])) + 1e-9)
                << i << " answered " << j;
        }
        EXPECT_EQ(sum, task.given[i] ? kTrials : 0);
    }
}

}  // namespace
}  // namespace tacto
