// Which participants are served: a condition counts only if it is presented, felt and not too strong.
#include <gtest/gtest.h>

#include "core/analysis/variation/VariationJson.h"
#include "tests/support/Limits.h"

namespace tacto {
namespace {

VariationOptions peopleWith(AmplitudeLevels levels, double discomfort_ma = 9.8) {
    VariationOptions out;
    out.trials = 5;
    out.stimulation.source = idealSource(Drive::Current);
    out.stimulation.limits = test::limitSets();
    out.stimulation.levels = levels;
    out.population.discomfort_ma = discomfort_ma;
    return out;
}

TEST(VariationServed, ThePapersRangeServesHardlyAnyone) {
    // 10 to 40 V span the range from perception to intolerance: a participant who feels the low end does not tolerate
    // the high end.
    const std::pair<double, std::size_t> mostServed[] = {{6.9, 0}, {9.8, 4}, {13.8, 24}};
    for (const auto& [discomfort, most] : mostServed) {
        const auto found = predictVariation(peopleWith(AmplitudeLevels::Profile, discomfort)).value();
        EXPECT_LE(found.served, most) << "of 200, too strong from " << discomfort;
        EXPECT_EQ(found.served + found.refusedPeople + found.unfeltPeople + found.withoutRange, 200U);
        EXPECT_GT(found.refusedPeople, 80U);
        EXPECT_GT(found.conditions[0].notFelt, 90U);
        const auto own = predictVariation(peopleWith(AmplitudeLevels::Personal, discomfort)).value();
        EXPECT_GT(own.served, 90U);
    }
}

TEST(VariationServed, UnfeltConditionsAreNotSeparable) {
    RecordProperty("hazard", "H9");
    const auto wanted = peopleWith(AmplitudeLevels::Profile, 13.8);
    const auto found = predictVariation(wanted).value();
    ASSERT_GT(found.complete, 50U) << "they are presented everything";
    ASSERT_LT(found.served, found.complete / 2) << "most of them do not feel 10 V";
    EXPECT_LT(found.presentedAccuracy.value, 0.6);
    EXPECT_GT(found.accuracy.low, 0.6) << "of the served alone";
    EXPECT_LE(found.clearlySeparable, found.served);
    EXPECT_NEAR(toJson(found, wanted)["clearly_separable_share"].get<double>(),
                static_cast<double>(found.clearlySeparable) / 200, 1e-12);
    // smooth-low / smooth-high: both have 10 V.
    EXPECT_EQ(found.pairs[0].participants, found.conditions[0].counted);
    EXPECT_LT(found.pairs[0].participants, found.conditions[0].presented);
}

TEST(VariationServed, NoOneServedHasNoAccuracy) {
    auto wanted = peopleWith(AmplitudeLevels::Profile);
    wanted.population.detection_ma = {20, 1};
    wanted.population.attention_ma = {30, 1};
    wanted.population.intolerance_ma = {60, 1};
    wanted.population.discomfort_ma = 60;
    const auto found = predictVariation(wanted).value();
    EXPECT_EQ(found.served, 0U);
    EXPECT_GT(found.complete, 150U);
    EXPECT_EQ(found.unfeltPeople, found.complete);
    EXPECT_TRUE(std::isnan(found.accuracy.value));
    EXPECT_LT(found.presentedAccuracy.value, 0.3);
    EXPECT_FALSE(found.trials);
    EXPECT_TRUE(found.pilots.empty());
    EXPECT_TRUE(found.accuracies.empty());
    for (const auto& row : found.confusion) EXPECT_EQ(row, std::vector<std::size_t>(5, 0));
    const auto json = toJson(found, wanted);
    EXPECT_TRUE(json["accuracy"]["median"].is_null());
    EXPECT_EQ(json["clearly_separable_share"], 0.0);
}

TEST(VariationServed, ThresholdsOfEachConditionAreCountedApart) {
    auto wanted = peopleWith(AmplitudeLevels::Profile);
    wanted.participants = 4;
    for (auto* drawn :
         {&wanted.population.series_ohm, &wanted.population.parallel_ohm, &wanted.population.capacitance_nf,
          &wanted.population.detection_ma, &wanted.population.attention_ma, &wanted.population.intolerance_ma}) {
        drawn->spread = 1;
    }
    // 40 V gives 11.43 mA into 3.50 kΩ. Thresholds at 200 µs are 0.875 of those at 150 µs: 12.1 mA is not tolerated.
    const auto found = predictVariation(wanted).value();
    EXPECT_EQ(found.conditions[0].drawsAttention, 0U);
    EXPECT_EQ(found.conditions[2].drawsAttention, 4U);
    EXPECT_EQ(found.conditions[2].tooStrong, 4U);
    EXPECT_EQ(found.conditions[2].notTolerated, 0U);
    EXPECT_EQ(found.conditions[2].refused, 4U);
    EXPECT_EQ(found.conditions[0].notFelt, 4U) << "2.86 mA, felt from 3.06 mA";
    EXPECT_EQ(found.refusedPeople, 4U);
}

TEST(VariationServed, ALargerElectrodeLowersTheImpedanceAndTheVoltageThatIsFelt) {
    auto wanted = peopleWith(AmplitudeLevels::Profile);
    const auto small = predictVariation(wanted).value();
    wanted.stimulation.electrodeArea = SquareCentimetres(4);
    const auto large = predictVariation(wanted).value();
    EXPECT_LT(large.impedance_ohm.value, 0.35 * small.impedance_ohm.value);
    EXPECT_LT(large.conditions[0].notFelt, small.conditions[0].notFelt / 4);
    EXPECT_EQ(large.detection_ma.value, small.detection_ma.value);
}

TEST(VariationServed, PremisesNameTheirSourcesAndWhatWasSet) {
    auto wanted = peopleWith(AmplitudeLevels::Personal);
    wanted.population.attention_ma.median = 7.5;
    wanted.population.intolerance_ma.spread = 1.6;
    wanted.stimulation.electrodeArea = SquareCentimetres(2);
    std::size_t choices = 0;
    bool parallel = false, capacitance = false;
    for (const auto& premise : premisesOf(wanted)) {
        EXPECT_FALSE(premise.source.empty()) << premise.quantity;
        choices += premise.mark == PremiseMark::Choice ? 1 : 0;
        if (premise.quantity.starts_with("Attention")) {
            EXPECT_EQ(premise.mark, PremiseMark::Set);
            EXPECT_EQ(premise.value, "7.5 mA");
            EXPECT_NE(premise.source.find("shipped: 6.9 mA"), std::string::npos) << premise.source;
        }
        if (premise.quantity.starts_with("Perception")) {
            EXPECT_EQ(premise.mark, PremiseMark::Source);
            EXPECT_EQ(premise.spread, "1.4 (choice)") << "the source gives a median, and no spread";
            EXPECT_NE(premise.source.find("10.1038/s41598-022-10708-9"), std::string::npos) << premise.source;
        }
        if (premise.quantity.starts_with("Intolerance")) {
            EXPECT_EQ(premise.mark, PremiseMark::Source);
            EXPECT_EQ(premise.spread, "1.6 (set)");
        }
        parallel =
            parallel || (premise.quantity == "Parallel resistance of the skin under 2 cm²" && premise.value == "5 kΩ");
        capacitance = capacitance || (premise.quantity == "C under 2 cm²" && premise.value == "100 nF");
    }
    EXPECT_GE(choices, 6U);
    EXPECT_TRUE(parallel && capacitance);
}

}  // namespace
}  // namespace tacto
