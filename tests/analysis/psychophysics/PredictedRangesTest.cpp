// Predictions of pilot.md section 8 for virtual participants: how many have a usable range, and their accuracy.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/psychophysics/PersonalRange.h"
#include "core/electrode/LoadResponse.h"
#include "core/encoding/EncodingProfile.h"
#include "tests/analysis/psychophysics/Procedures.h"
#include "tests/support/Figures.h"
#include "tests/support/Trials.h"

namespace tacto {
namespace {

constexpr double kCeiling_v = 40, kStep_ma = 0.5, kCap_ma = 15;

PopulationModel populationWith(double tooStrong_ma, double amplitudeWeber = kAmplitudeWeberFraction) {
    PopulationModel model;
    model.discomfort_ma = tooStrong_ma;
    model.amplitudeWeber.median = amplitudeWeber;
    return model;
}

double impedanceOf(const VirtualParticipant& who) {
    PulseTrain train = EncodingProfile().train;
    train.amplitude = Milliamps(1);
    return effectiveImpedance(who.skin, segmentsOf(train, GapState::HoldsZero).items[0]).value();
}

std::optional<LevelGrid> gridOf(const VirtualParticipant& who) {
    const std::vector<LevelCeiling> ceilings = {{kCap_ma, LevelLimit::Cap},
                                                {1e3 * kCeiling_v / impedanceOf(who), LevelLimit::Gate}};
    const auto grid = LevelGrid::create(LevelUnit::Current, kStep_ma, ceilings);
    return grid ? std::optional(*grid) : std::nullopt;
}

double expectedAccuracy(const VirtualObserver& observer, const PersonalRangeResult& range) {
    const std::vector<DeliveredCondition> conditions = {
        {range.min, Seconds(2)}, {range.min, Seconds(0.5)}, {range.max, Seconds(2)}, {range.max, Seconds(0.5)}};
    const auto table = observer.predicted(conditions, Seconds(0));
    return (table[0][0] + table[1][1] + table[2][2] + table[3][3]) / 4;
}

struct Ranges {
    double usable = 0;  ///< share of participants with a usable range
    double median = 0;  ///< median accuracy of these participants
    double low = 0;     ///< 5 % quantile
    double high = 0;    ///< 95 % quantile
};

template <class RangeOf>
Ranges rangesOver(std::size_t people, const PopulationModel& model, RangeOf rangeOf) {
    std::vector<double> accuracies;
    for (std::size_t i = 0; i < people; ++i) {
        const auto who = drawParticipant(model, 1, i, Micros(200));
        const auto observer = test::observerFor(who, i);
        const auto grid = gridOf(who);
        if (!grid) continue;
        const std::optional<PersonalRangeResult> range = rangeOf(*grid, observer, i);
        if (range && range->usable) accuracies.push_back(expectedAccuracy(observer, *range));
    }
    std::ranges::sort(accuracies);
    const auto n = static_cast<double>(accuracies.size());
    const auto at = [&](double q) { return accuracies.at(static_cast<std::size_t>(q * (n - 1))); };
    return {n / static_cast<double>(people), at(0.5), at(0.05), at(0.95)};
}

/// Returns the range if the thresholds are known without error.
std::optional<PersonalRangeResult> knownRange(const LevelGrid& grid, const VirtualObserver& observer, std::size_t) {
    auto range = PersonalRange::create(grid, {.detection = observer.detection(), .tooStrong = observer.tooStrong()});
    if (!range->done()) {
        EXPECT_TRUE(range->answer(true));
    }
    return range->result();
}

/// Returns the range that a session measures.
std::optional<PersonalRangeResult> measuredRange(const LevelGrid& grid, const VirtualObserver& observer,
                                                 std::size_t index) {
    const auto limits = test::ascend(grid, observer, index);
    if (std::isnan(limits.felt)) return std::nullopt;
    QuestPlusSettings settings;
    settings.felt = limits.felt;
    auto quest = QuestPlus::create(grid, settings, index).value();
    test::answerAll(quest, observer);
    auto range = PersonalRange::create(grid, {.detection = quest.result().estimate.value,
                                              .tooStrong = limits.tooStrong,
                                              .saidTooStrong = limits.saidTooStrong})
                     .value();
    while (const auto level = range.next()) {
        EXPECT_TRUE(range.answer(observer.acceptable(std::to_string(*level), *level, Seconds(0))));
    }
    return range.result();
}

TEST(PredictedRanges, AreThoseOfAnIndependentModelWhereThresholdsAreKnown) {
    constexpr std::size_t kPeople = 4000;
    for (const auto& row : test::figuresOf("predicted_ranges").at("known")) {
        const double tooStrong = row.at("too_strong_ma"), weber = row.at("weber"), usable = row.at("usable");
        const auto found = rangesOver(kPeople, populationWith(tooStrong, weber), knownRange);
        std::printf("known, too strong from %.1f mA, Weber %.2f: %.3f usable, %.3f (%.3f to %.3f)\n", tooStrong, weber,
                    found.usable, found.median, found.low, found.high);
        // Four standard errors for this number of people.
        EXPECT_NEAR(found.usable, usable, 4 * std::sqrt(usable * (1 - usable) / kPeople));
        EXPECT_NEAR(found.median, row.at("median").get<double>(), 0.01);
        EXPECT_NEAR(found.low, row.at("low").get<double>(), 0.02);
        EXPECT_NEAR(found.high, row.at("high").get<double>(), 0.01);
    }
}

TEST(PredictedRanges, AreNarrowerWhereASessionMeasuresThresholds) {
    const auto people = test::trials<std::size_t>({.local = 400, .ci = 2000, .campaign = 20'000});
    double last = 0;
    for (const double tooStrong : {6.9, 9.8, 13.8}) {
        const auto known = rangesOver(people, populationWith(tooStrong), knownRange);
        const auto found = rangesOver(people, populationWith(tooStrong), measuredRange);
        std::printf("measured, too strong from %.1f mA: %.3f usable (known: %.3f), %.3f (%.3f to %.3f)\n", tooStrong,
                    found.usable, known.usable, found.median, found.low, found.high);
        EXPECT_GT(found.usable, last);
        // With noise, the first "too strong" of rising levels comes below the level that is too strong half the time.
        EXPECT_LT(found.usable, known.usable);
        EXPECT_GT(found.usable, known.usable - 0.2);
        last = found.usable;
    }
}

TEST(PredictedRanges, TenToFortyVoltsServesAlmostNone) {
    const struct {
        double tooStrong_ma, share;
    } design[] = {{6.9, 0}, {9.8, 0}, {13.8, 0.06}};
    for (const auto& row : design) {
        std::size_t served = 0;
        for (std::size_t i = 0; i < 4000; ++i) {
            const auto who = drawParticipant(populationWith(row.tooStrong_ma), 1, i, Micros(200));
            const double perVolt = 1e3 / impedanceOf(who);
            if (10 * perVolt >= who.detection.value() && 40 * perVolt < who.discomfort.value()) ++served;
        }
        std::printf("10 to 40 V, too strong from %.1f mA: %.4f\n", row.tooStrong_ma,
                    static_cast<double>(served) / 4000);
        EXPECT_NEAR(static_cast<double>(served) / 4000, row.share, 0.03);
    }
}

}  // namespace
}  // namespace tacto
