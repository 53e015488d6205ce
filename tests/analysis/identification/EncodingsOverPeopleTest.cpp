#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

#include "core/analysis/identification/EncodingsOverPeople.h"
#include "core/analysis/statistics/InformationTransfer.h"
#include "core/base/Random.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

const std::vector<std::string> kNames = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

/// Test trials of one session, right with the probability `skill`; otherwise any answer.
std::vector<IdentificationTrial> sessionOf(double skill, std::size_t trials, Random& random) {
    std::vector<IdentificationTrial> all;
    for (std::size_t i = 0; i < trials; ++i) {
        IdentificationTrial trial;
        trial.number = i + 1;
        trial.block = 1 + i / 16;
        trial.condition = kNames[i % kNames.size()];
        trial.response = random.uniform() < skill ? trial.condition : kNames[random.below(kNames.size())];
        if (random.below(20) == 0) trial.response = kNoneResponse;
        all.push_back(std::move(trial));
    }
    return all;
}

/// Quantile of Student's t by integrating its density, written from the definition.
double studentByHand(double p, double freedom) {
    const double scale =
        std::exp(std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2)) / std::sqrt(freedom * std::numbers::pi);
    double mass = 0.5, x = 0;
    constexpr double kStep = 1e-4;
    const auto density = [&](double t) { return scale * std::pow(1 + t * t / freedom, -(freedom + 1) / 2); };
    while (mass < p) {
        mass += kStep * (density(x) + 4 * density(x + kStep / 2) + density(x + kStep)) / 6;
        x += kStep;
    }
    return x;
}

TEST(EncodingsOverPeople, MeanIntervalAndExchangesAreThoseCountedByHand) {
    RecordProperty("hazard", "H9");
    Random random(49, "encodings over people");
    const int rounds = test::trials<int>({.local = 40, .ci = 200, .campaign = 2000});
    for (int round = 0; round < rounds; ++round) {
        const std::size_t people = 2 + random.below(6);
        std::vector<PersonEncodings> all;
        std::vector<double> differences;
        double trials = 0;
        std::size_t better = 0;
        for (std::size_t i = 0; i < people; ++i) {
            std::vector<Identification> kept;
            std::vector<std::string> encodings;
            const std::size_t sessions = 2 + random.below(3);
            std::size_t hits[2] = {0, 0}, n[2] = {0, 0};
            for (std::size_t s = 0; s < sessions; ++s) {
                const std::size_t which = s < 2 ? (s + i) % 2 : random.below(2);
                const auto rows = sessionOf(0.2 + 0.7 * random.uniform(), 16 + 16 * random.below(4), random);
                for (const auto& row : rows) {
                    ++n[which];
                    hits[which] += row.response == row.condition ? 1 : 0;
                }
                kept.push_back(identify(rows, kNames).value());
                encodings.emplace_back(which == 0 ? "standard" : "swapped");
            }
            std::vector<EncodedSession> given;
            for (std::size_t s = 0; s < sessions; ++s) given.push_back({encodings[s], &kept[s]});
            all.push_back({std::to_string(i), encodingResults(given)});
            ASSERT_EQ(all.back().encodings.size(), 2U);
            for (const auto& each : all.back().encodings) {
                const std::size_t which = each.encoding == "standard" ? 0 : 1;
                EXPECT_EQ(each.hits, hits[which]);
                EXPECT_EQ(each.n, n[which]);
                // The information is that of the added tables.
                std::vector<std::vector<double>> table(4, std::vector<double>(6, 0));
                for (std::size_t s = 0; s < sessions; ++s) {
                    if (encodings[s] != each.encoding) continue;
                    for (std::size_t r = 0; r < 4; ++r) {
                        for (std::size_t c = 0; c < 6; ++c) table[r][c] += double(kept[s].confusion[r][c]);
                    }
                }
                EXPECT_NEAR(each.itCorrected_bits.value, correctedInformation(table).value, 1e-12);
            }
            double shares[2];
            for (const std::size_t which : {0U, 1U}) {
                shares[which] = double(hits[which]) / double(n[which]);
                const double p = (double(hits[which]) + 2) / (double(n[which]) + 4);
                trials += p * (1 - p) / (double(n[which]) + 4);
            }
            differences.push_back(shares[1] - shares[0]);
            better += shares[1] > shares[0] ? 1 : 0;
        }
        const double n = double(people);
        const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / n;
        double squares = 0;
        for (const double each : differences) squares += (each - mean) * (each - mean);
        const double error = std::sqrt(std::max(squares / (n - 1) / n, trials / (n * n)));
        const double reach = studentByHand(0.975, n - 1) * error;

        const auto found = compareEncodingsOver(all);
        ASSERT_EQ(found.pairs.size(), 1U);
        const auto& pair = found.pairs.front();
        EXPECT_EQ(pair.a, "swapped");
        EXPECT_NEAR(pair.accuracy.value, mean, 1e-12);
        EXPECT_NEAR(pair.accuracy.low, mean - reach, 1e-3 * (1 + reach));
        EXPECT_NEAR(pair.accuracy.high, mean + reach, 1e-3 * (1 + reach));
        EXPECT_EQ(pair.aBetter, better);
        EXPECT_EQ(found.better, pair.accuracy.low > 0 ? "swapped" : pair.accuracy.high < 0 ? "standard" : "");
        // Each person's sign by recursion.
        std::size_t asFar = 0;
        const auto flip = [&](auto&& self, std::size_t i, double sum) -> void {
            if (i == people) {
                asFar += std::abs(sum) > std::abs(mean * n) - 1e-9 ? 1 : 0;
                return;
            }
            self(self, i + 1, sum + differences[i]);
            self(self, i + 1, sum - differences[i]);
        };
        flip(flip, 0, 0);
        EXPECT_NEAR(pair.exchangeP, double(asFar) / std::pow(2, n), 1e-12);
    }
}

/// The interval holds the true mean difference about as often as it says, for people who differ and people who do not.
TEST(EncodingsOverPeople, TheIntervalHoldsTheTruth) {
    RecordProperty("hazard", "H9");
    Random random(17, "coverage over people");
    const int studies = test::trials<int>({.local = 400, .ci = 2000, .campaign = 20'000});
    for (const double spread : {0.0, 0.1}) {
        for (const std::size_t people : {3U, 5U}) {
            int held = 0;
            for (int study = 0; study < studies; ++study) {
                std::vector<double> values, variances;
                for (std::size_t i = 0; i < people; ++i) {
                    const double shift = spread * random.normal();
                    double share[2] = {0, 0}, variance = 0;
                    for (const int which : {0, 1}) {
                        int hits = 0;
                        for (int trial = 0; trial < 80; ++trial)
                            hits += random.uniform() < 0.55 + (which == 1 ? 0.1 + shift : 0.0) ? 1 : 0;
                        share[which] = hits / 80.0;
                        variance += (hits + 2.0) / 84 * (82.0 - hits) / 84 / 84;
                    }
                    values.push_back(share[1] - share[0]);
                    variances.push_back(variance);
                }
                const auto found = meanOverPeople(values, variances);
                held += found.low <= 0.1 && 0.1 <= found.high ? 1 : 0;
            }
            EXPECT_GT(held, 0.93 * studies) << spread << ", " << people;
        }
    }
}

TEST(EncodingsOverPeople, OnePersonOrNobodyDecidesNothingAndSaysSo) {
    RecordProperty("hazard", "H9");
    const EncodingResult good{.encoding = "swapped", .n = 80, .hits = 76},
        bad{.encoding = "standard", .n = 80, .hits = 30};
    const auto one = compareEncodingsOver({{"A", {bad, good}}, {"B", {good}}});
    ASSERT_EQ(one.pairs.size(), 1U);
    EXPECT_TRUE(one.better.empty());
    EXPECT_TRUE(std::isnan(one.pairs.front().accuracy.low));
    EXPECT_NE(encodingSentences(one).at(0).find("not decided"), std::string::npos);
    EXPECT_TRUE(encodingSentences(compareEncodingsOver({{"B", {good}}})).empty());
    EXPECT_TRUE(compareEncodingsOver({}).pairs.empty());
    // Three people who agree to the last answer: the interval keeps the width that the trials give.
    const auto alike = compareEncodingsOver({{"A", {good, bad}}, {"B", {good, bad}}, {"C", {good, bad}}});
    EXPECT_LT(alike.pairs.front().accuracy.low, alike.pairs.front().accuracy.value - 0.05);
    EXPECT_EQ(alike.better, "swapped");
    EXPECT_NE(encodingSentences(alike).at(0).find("practice"), std::string::npos) << "all had it first";
}

}  // namespace
}  // namespace tacto
