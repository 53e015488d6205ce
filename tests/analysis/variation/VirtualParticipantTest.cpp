#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/variation/VirtualParticipant.h"
#include "core/base/Statistics.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

TEST(PopulationModel, RefusesEachFigureOutsideItsRangeByName) {
    ASSERT_TRUE(validate(PopulationModel()));
    for (const auto& field : populationFields()) {
        for (const double wrong : {std::nextafter(field.accepted.low, -1.0), 1.01 * field.accepted.high, kNaN}) {
            PopulationModel model;
            field.in(model) = wrong;
            const auto refused = validate(model);
            ASSERT_THAT(refused, test::refused(ErrorCode::InvalidArgument)) << field.key << " " << wrong;
            EXPECT_EQ(refused.error().message.find("the " + std::string(field.name) + " is "), 0U)
                << refused.error().message;
        }
    }
    PopulationModel spread;
    spread.attention_ma.spread = 0.99;
    EXPECT_THAT(validate(spread),
                test::refusedSaying(testing::StrEq(
                    "the spread of the attention threshold is 0.99; a number from 1 to 10 is expected")));
}

TEST(VirtualParticipant, EachThresholdHasItsMedianAndSpread) {
    const PopulationModel model;
    constexpr std::size_t kPeople = 4000;
    struct Drawn {
        const LogNormal& model;
        Milliamps VirtualParticipant::*member;
        std::vector<double> logs = {};
    } drawn[] = {{model.detection_ma, &VirtualParticipant::detection},
                 {model.attention_ma, &VirtualParticipant::attention},
                 {model.intolerance_ma, &VirtualParticipant::intolerance}};
    for (std::size_t i = 0; i < kPeople; ++i) {
        const auto who = drawParticipant(model, 5, i, model.thresholdWidth);
        for (auto& each : drawn) each.logs.push_back(std::log((who.*each.member).value()));
        EXPECT_GE(who.lapse, 0);
        EXPECT_LT(who.lapse, model.lapseMost);
    }
    const double sd = std::log(1.4);
    for (const auto& each : drawn) {
        const auto found = statisticsOf(each.logs);
        // Five standard deviations of the estimates; the seed is fixed.
        EXPECT_NEAR(found.mean, std::log(each.model.median), 5 * sd / std::sqrt(1.0 * kPeople));
        EXPECT_NEAR(found.sd, sd, 5 * sd / std::sqrt(2.0 * kPeople));
    }
    double covariance = 0;
    for (std::size_t i = 0; i < kPeople; ++i) {
        covariance += (drawn[0].logs[i] - std::log(3.5)) * (drawn[2].logs[i] - std::log(13.8)) / kPeople;
    }
    EXPECT_NEAR(covariance / (sd * sd), 0.8, 0.05);
}

TEST(VirtualParticipant, ThresholdsAreInOrderHoweverFarPeopleDiffer) {
    PopulationModel model;
    for (auto* each : {&model.detection_ma, &model.attention_ma, &model.intolerance_ma}) each->spread = 10;
    model.thresholdCorrelation = 0;
    for (std::size_t i = 0; i < 2000; ++i) {
        const auto who = drawParticipant(model, 5, i, model.thresholdWidth);
        EXPECT_LT(who.detection, who.attention);
        EXPECT_LT(who.attention, who.intolerance);
        EXPECT_GT(who.discomfort, who.detection);
    }
}

TEST(VirtualParticipant, WhatIsTooStrongLiesWhereTheMedianPersonsDoes) {
    PopulationModel model;
    const auto at = [&model](double median) {
        model.discomfort_ma = median;
        return drawParticipant(model, 9, 4, model.thresholdWidth);
    };
    const auto attention = at(6.9), between = at(std::sqrt(6.9 * 13.8)), intolerance = at(13.8), beyond = at(27.6);
    EXPECT_NEAR(attention.discomfort.value(), attention.attention.value(), 1e-12);
    EXPECT_NEAR(intolerance.discomfort.value(), intolerance.intolerance.value(), 1e-12);
    EXPECT_NEAR(between.discomfort.value(), std::sqrt(between.attention.value() * between.intolerance.value()), 1e-12);
    EXPECT_NEAR(beyond.discomfort.value(), 2 * beyond.intolerance.value(), 1e-12);
    const auto below = at(std::sqrt(3.5 * 6.9));
    EXPECT_NEAR(below.discomfort.value(), std::sqrt(below.detection.value() * below.attention.value()), 1e-12);
}

TEST(VirtualParticipant, ParallelResistanceFallsAndCapacitanceGrowsWithTheArea) {
    const PopulationModel model;
    const auto one = drawParticipant(model, 3, 2, Micros(200));
    const auto four = drawParticipant(model, 3, 2, Micros(200), SquareCentimetres(4));
    EXPECT_EQ(drawParticipant(model, 3, 2, Micros(200), SquareCentimetres(1)).skin, one.skin);
    EXPECT_NEAR(four.skin.parallel.value(), one.skin.parallel.value() / 4, 1e-9);
    EXPECT_NEAR(four.skin.capacitance.value(), one.skin.capacitance.value() * 4, 1e-9);
    EXPECT_EQ(four.skin.series, one.skin.series);
    EXPECT_EQ(four.detection, one.detection);
    EXPECT_EQ(four.intolerance, one.intolerance);
}

TEST(VirtualParticipant, LongerPulsesAreFeltAtLessCurrentByWeissLaw) {
    const PopulationModel model;
    const double at150 = drawParticipant(model, 1, 0, Micros(150)).detection.value();
    const double at300 = drawParticipant(model, 1, 0, Micros(300)).detection.value();
    EXPECT_NEAR(at300 / at150, (1 + 151.0 / 300) / (1 + 151.0 / 150), 1e-12);
}

}  // namespace
}  // namespace tacto
