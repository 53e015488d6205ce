#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/psychophysics/PredictedFit.h"
#include "core/analysis/psychophysics/TrialPlan.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Figures.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

std::vector<PredictedTrial> trialsOf(const std::vector<std::size_t>& counts, const std::vector<double>& probabilities) {
    std::vector<PredictedTrial> out;
    for (std::size_t response = 0; response < counts.size(); ++response) {
        out.insert(out.end(), counts[response], {0, response, probabilities});
    }
    return out;
}

TEST(PredictedFit, AgreesWithEveryTableThereIs) {
    for (const auto& row : test::figuresOf("psychophysics").at("fit")) {
        const auto trials = trialsOf(row.at("counts").get<std::vector<std::size_t>>(),
                                     row.at("probabilities").get<std::vector<double>>());
        const double larger = row.at("larger").get<double>(), equal = row.at("equal").get<double>();
        double least = 1, most = 0;
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            const auto fit = fitOf(trials, 1, seed).value();
            EXPECT_NEAR(fit.all.g, row.at("g").get<double>(), 1e-9);
            EXPECT_EQ(fit.rows.at(0).g, fit.all.g);
            least = std::min(least, fit.all.p);
            most = std::max(most, fit.all.p);
        }
        // The value is uniform between the shares with larger G and with G at least as large.
        EXPECT_GT(least, larger - 0.02);
        EXPECT_LT(most, larger + equal + 0.02);
        EXPECT_NEAR(least, larger, 0.02 + 0.15 * equal);
        EXPECT_NEAR(most, larger + equal, 0.02 + 0.15 * equal);
    }
}

/// Simulates a test of 80 trials as delivered; thresholds rise during the test.
std::vector<PredictedTrial> session(const VirtualObserver& who, const VirtualObserver& believed, std::uint64_t seed) {
    const std::vector<DeliveredCondition> conditions = {
        {4, Seconds(2)}, {4, Seconds(0.5)}, {6.5, Seconds(2)}, {6.5, Seconds(0.5)}};
    std::vector<PredictedTrial> out;
    double stimulated = 0;
    const auto plan = planTrials({}, seed).value();
    for (const auto& trial : plan) {
        if (trial.phase != TrialPhase::Test || !trial.condition) continue;
        const Seconds before(stimulated);
        const auto key = std::to_string(trial.number);
        out.push_back({*trial.condition, who.identify(key, conditions, trial.condition, before),
                       believed.predicted(conditions, before)[*trial.condition]});
        stimulated += 4;
    }
    return out;
}

/// Returns the Kolmogorov-Smirnov D times √n, for values that should be uniform between 0 and 1.
double kolmogorov(std::vector<double> p) {
    std::ranges::sort(p);
    const auto n = static_cast<double>(p.size());
    double d = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        d = std::max({d, p[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p[i]});
    }
    return d * std::sqrt(n);
}

TEST(PredictedFit, IsEvenOverVirtualParticipants) {
    const auto seeds = test::trials<std::uint64_t>({.local = 200, .ci = 600, .campaign = 5000});
    for (const double adaptation : {0.0, 0.3}) {
        std::vector<double> p, rows;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            // The observers differ as people do. Some make hardly any error, so that most tables are equal.
            const auto observer = test::observerFor(drawParticipant({}, 3, seed, Micros(200)), seed, adaptation);
            const auto fit = fitOf(session(observer, observer, seed), 4, seed, 500).value();
            p.push_back(fit.all.p);
            rows.push_back(fit.rows[seed % 4].p);
        }
        std::printf("adaptation %g: %.2f of all, %.2f of rows\n", adaptation, kolmogorov(p), kolmogorov(rows));
        EXPECT_LT(kolmogorov(p), 1.63);  // critical value at 1 %
        EXPECT_LT(kolmogorov(rows), 1.63);
    }
}

TEST(PredictedFit, FindsAPredictionThatIsWrong) {
    std::size_t found = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        auto who = test::medianParticipant();
        const auto believed = test::observerFor(who, seed);
        who.noise_jnd = 3;
        const auto fit = fitOf(session(test::observerFor(who, seed), believed, seed), 4, seed, 500).value();
        if (fit.all.p < 0.05) ++found;
    }
    EXPECT_GE(found, 45U);
}

TEST(PredictedFit, AnImpossibleAnswerFitsNothing) {
    auto trials = trialsOf({5, 5, 0}, {0.5, 0.5, 0});
    trials[0].response = 2;
    const auto fit = fitOf(trials, 2, 1, 1000).value();
    EXPECT_TRUE(std::isinf(fit.all.g));
    EXPECT_LT(fit.all.p, 0.002);
    EXPECT_TRUE(std::isnan(fit.rows[1].g)) << "no trial of it";
    EXPECT_TRUE(fit.predicted[1].empty());
    EXPECT_EQ(fit.predicted[0], (std::vector<double>{0.5, 0.5, 0}));
}

TEST(PredictedFit, RefusesWhatIsNoPrediction) {
    const auto refused = [](auto change, std::size_t draws = 10) {
        auto trials = trialsOf({5, 5}, {0.5, 0.5});
        change(trials);
        return !fitOf(trials, 1, 1, draws);
    };
    EXPECT_FALSE(refused([](auto&) {}));
    EXPECT_TRUE(refused([](auto&) {}, 0));
    EXPECT_TRUE(refused([](auto& t) { t.clear(); }));
    EXPECT_TRUE(refused([](auto& t) { t[3].condition = 1; }));
    EXPECT_TRUE(refused([](auto& t) { t[3].response = 2; }));
    EXPECT_TRUE(refused([](auto& t) { t[3].probabilities = {1}; }));
    EXPECT_TRUE(refused([](auto& t) { t[3].probabilities = {0.5, 0.4}; }));
    EXPECT_TRUE(refused([](auto& t) { t[3].probabilities = {1.5, -0.5}; }));
    EXPECT_TRUE(refused([](auto& t) { t[3].probabilities = {std::nan(""), 0.5}; }));
}

}  // namespace
}  // namespace tacto
