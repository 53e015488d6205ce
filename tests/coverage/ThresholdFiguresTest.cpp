// The figures of a person: the detection threshold, its drift, and the Weber fraction of strength, with their
// intervals. The people are drawn from the prior on which the intervals are based, so by Bayes' rule 95 % of intervals
// contain the truth; any other share shows an error in model, posterior or quantiles. Answers are drawn from the
// model's formula, which is repeated here independently.
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/psychophysics/QuestPlus.h"
#include "core/analysis/psychophysics/StrengthComparison.h"
#include "core/base/Random.h"
#include "tests/coverage/CoverageTable.h"

namespace tacto::test {
namespace {

constexpr double kFelt_ma = 4;

LevelGrid grid() {
    return LevelGrid::create(LevelUnit::Current, 0.1, std::vector<LevelCeiling>{{25, LevelLimit::Cap}}).value();
}

TrialInterval said(Random& random, TrialInterval right, double probability) {
    if (random.uniform() < probability) return right;
    return right == TrialInterval::First ? TrialInterval::Second : TrialInterval::First;
}

/// A person with a random threshold near `median_ma`, and with the slope of the model.
struct Person {
    double threshold_db, slope;
    [[nodiscard]] double right(double level_ma) const {
        const double over = slope * (20 * std::log10(level_ma) - threshold_db) / 20;
        return 0.5 + 0.48 * (1 - std::exp(-std::pow(10, over)));
    }
    [[nodiscard]] double threshold_ma() const { return std::pow(10, threshold_db / 20); }
};

Person drawn(Random& random, double median_ma, double sd_db) {
    constexpr double kSlopes[] = {2, 4, 8, 16};
    const double felt_db = 20 * std::log10(kFelt_ma);
    double threshold = 0;
    do {
        threshold = 20 * std::log10(median_ma) + sd_db * random.normal();
    } while (threshold < felt_db - 12 || threshold > felt_db + 9);  // the range that the procedure considers
    return {threshold, kSlopes[random.below(4)]};
}

TEST(Coverage, ThresholdsOfAPerson) {
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= 4 * coverageRuns(); ++seed) {
        Random random(seed, "person");
        const auto person = drawn(random, kFelt_ma * std::pow(10, -1 / 20.0), 4);
        auto quest = QuestPlus::create(grid(), {.felt = kFelt_ma}, seed).value();
        while (const auto trial = quest.next())
            ASSERT_TRUE(quest.answer(said(random, trial->interval, person.right(trial->level))));
        table.add("detection threshold", person.threshold_ma(), quest.result().estimate);

        const double last_ma = kFelt_ma;
        const auto later = drawn(random, last_ma, 2.5);
        auto drift =
            DriftCheck::create(grid(), {.felt = kFelt_ma, .last = last_ma, .min = 0.1, .block = 1}, seed).value();
        while (drift.step() == DriftStep::Trial) {
            const auto trial = drift.next();
            ASSERT_TRUE(drift.answer(said(random, trial->interval, later.right(trial->level))));
        }
        table.add("detection threshold, checked", later.threshold_ma(), drift.result().checks.front().estimate);
    }
    table.judge("person");
}

TEST(Coverage, WeberFractionOfAPerson) {
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= 4 * coverageRuns(); ++seed) {
        Random random(seed, "Weber fraction");
        double weber = 0;
        do {
            weber = std::exp(std::log(0.10) + std::log(2.0) * random.normal());
        } while (weber < 0.01 || weber > 1);
        auto comparison = StrengthComparison::create(grid(), {.low = 4, .high = 9}, seed).value();
        while (const auto trial = comparison.next()) {
            const double apart = std::log(trial->pair.stronger / trial->pair.weaker) / std::log(1 + weber);
            ASSERT_TRUE(comparison.answer(said(random, trial->interval, 0.5 + 0.48 * std::erf(apart / 2))));
        }
        table.add("Weber fraction", weber, comparison.result().weber);
    }
    table.judge("person");
}

}  // namespace
}  // namespace tacto::test
