#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "core/analysis/variation/IndexedWork.h"
#include "core/analysis/variation/Variation.h"
#include "core/analysis/variation/VariationJson.h"
#include "tests/support/InTime.h"
#include "tests/support/Limits.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

VariationOptions options(std::size_t participants = 60) {
    VariationOptions out;
    out.participants = participants;
    out.trials = 10;
    out.seed = 7;
    out.stimulation.source = idealSource(Drive::Current);
    out.stimulation.limits = test::limitSets();
    out.stimulation.electrodeArea = SquareCentimetres(1);
    return out;
}

/// Lets everybody feel from `felt` mA at 150 µs and tolerate up to `strong` mA.
void setThresholds(VariationOptions& options, double felt, double strong) {
    auto& population = options.population;
    population.detection_ma.median = felt;
    population.attention_ma.median = std::sqrt(felt * strong);
    population.intolerance_ma.median = strong;
    population.discomfort_ma = strong;
}

/// Returns a population in which everybody equals the median and nobody lapses.
VariationOptions everybodyAlike() {
    auto out = options(5);
    for (auto* drawn : {&out.population.series_ohm, &out.population.parallel_ohm, &out.population.capacitance_nf,
                        &out.population.detection_ma, &out.population.attention_ma, &out.population.intolerance_ma,
                        &out.population.amplitudeWeber, &out.population.intervalWeber}) {
        drawn->spread = 1;
    }
    out.population.lapseMost = 0;
    return out;
}

TEST(Variation, SameBitsWhateverTheNumberOfThreads) {
    auto wanted = options();
    wanted.threads = 1;
    const std::string alone = toJson(predictVariation(wanted).value(), wanted).dump();
    EXPECT_NE(alone.find("\"accuracy\""), std::string::npos);
    for (const unsigned threads : {2U, 3U, 8U, 0U}) {
        wanted.threads = threads;
        EXPECT_EQ(toJson(predictVariation(wanted).value(), wanted).dump(), alone) << threads << " threads";
    }
    wanted.seed = 8;
    EXPECT_NE(toJson(predictVariation(wanted).value(), wanted).dump(), alone);
}

TEST(Variation, OnePersonIsTheSameInACrowd) {
    const auto wanted = options();
    const auto first = drawParticipant(wanted.population, 7, 3, Micros(200));
    EXPECT_EQ(first.skin, predictParticipant(wanted, 3).who.skin);
    EXPECT_NE(first.skin, drawParticipant(wanted.population, 7, 4, Micros(200)).skin);
    EXPECT_NE(first.skin, drawParticipant(wanted.population, 8, 3, Micros(200)).skin);
}

TEST(Variation, CurrentIsTheCommandOverTheParticipantsImpedance) {
    auto wanted = everybodyAlike();
    wanted.stimulation.levels = AmplitudeLevels::Profile;
    setThresholds(wanted, 1, 20);
    const auto who = predictParticipant(wanted, 0);
    // science.md section 4: 3.50 kΩ for a current source into 200 Ω + (10 kΩ ∥ 50 nF) at 200 µs.
    const double z = 200 + 10e3 * (1 - std::exp(-200e-6 / (10e3 * 50e-9)));
    EXPECT_NEAR(who.delivery.impedance.value(), z, 1e-6 * z);
    EXPECT_NEAR(z, 3500, 10);
    const double volts[] = {10, 10, 40, 40}, seconds[] = {2, 0.5, 2, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(who.delivery.stimuli[i].current.value(), 1e3 * volts[i] / z, 1e-6);
        EXPECT_NEAR(who.delivery.stimuli[i].voltage.value(), volts[i], 1e-6);
        EXPECT_NEAR(who.delivery.stimuli[i].interval.count(), seconds[i], 1e-12);
    }
}

TEST(Variation, PeopleWhoAreAlikeHaveTheDistancesOfTheDefinition) {
    auto wanted = everybodyAlike();
    wanted.stimulation.levels = AmplitudeLevels::Profile;
    setThresholds(wanted, 0.5, 50);
    const auto found = predictVariation(wanted).value();
    ASSERT_EQ(found.pairs.size(), 6U);
    EXPECT_EQ(found.complete, 5U);
    const double amplitude = std::log(4) / std::log(1.10), interval = std::log(4) / std::log(1.16);
    EXPECT_NEAR(found.pairs[0].jnd.value, interval, 1e-9);
    EXPECT_NEAR(found.pairs[1].jnd.value, amplitude, 1e-9);
    EXPECT_NEAR(found.pairs[2].jnd.high, std::hypot(amplitude, interval), 1e-9);
    EXPECT_NEAR(found.accuracy.value, 1, 1e-5);
    EXPECT_NEAR(found.information.value, 2, 1e-3);
    EXPECT_EQ(found.clearlySeparable, 5U);
    EXPECT_EQ(found.served, 5U);
}

TEST(Variation, WhatTheGateWouldRefuseIsCountedAndNotGiven) {
    RecordProperty("hazard", "H1");
    auto wanted = everybodyAlike();
    wanted.stimulation.levels = AmplitudeLevels::Profile;
    wanted.stimulation.ceilings = {{Quantity::PeakCurrent, 5}};  // allows 10 V (2.9 mA) but not 40 V (11.4 mA)
    setThresholds(wanted, 1, 100);
    const auto limited = predictVariation(wanted).value();
    EXPECT_EQ(limited.refused, 2 * 5U);
    EXPECT_EQ(limited.complete, 0U);
    EXPECT_EQ(limited.conditions[0].presented, 5U);
    EXPECT_EQ(limited.conditions[3].refused, 5U);
    ASSERT_EQ(limited.withheld.size(), 1U);
    EXPECT_NE(limited.withheld.begin()->first.find("peak current"), std::string::npos)
        << limited.withheld.begin()->first;
    EXPECT_FALSE(limited.trials);
    EXPECT_TRUE(toJson(limited, wanted)["trials_needed"].is_null());
    EXPECT_TRUE(toJson(limited, wanted)["accuracy"]["median"].is_null());

    // The level is above what the participant tolerates: the gate's ceiling in person mode.
    wanted.stimulation.ceilings.clear();
    setThresholds(wanted, 1, 3);
    EXPECT_EQ(predictVariation(wanted).value().conditions[2].refused, 5U);
    // Skin outside the profile's range gets no stimulation at all.
    wanted.stimulation.loadHigh = Ohms(3000);
    EXPECT_EQ(predictVariation(wanted).value().refused, 4 * 5U);
}

TEST(Variation, WhatIsBelowDetectionIsNotFeltAndAnsweredNone) {
    auto wanted = everybodyAlike();
    wanted.stimulation.levels = AmplitudeLevels::Profile;
    setThresholds(wanted, 6, 60);  // 10 V gives 2.9 mA
    const auto found = predictVariation(wanted).value();
    EXPECT_EQ(found.notFelt, 2 * 5U);
    EXPECT_EQ(found.complete, 5U);
    EXPECT_NEAR(found.presentedAccuracy.value, 0.5, 1e-3);
    const auto counts = predictParticipant(wanted, 0).counts;
    EXPECT_EQ(counts[0][4], 10U);
    EXPECT_EQ(counts[2][4], 0U);
}

TEST(Variation, PersonalLevelsLieBetweenTheThresholdsAndInTheProfile) {
    RecordProperty("hazard", "H9");
    const auto wanted = options();
    std::size_t presented = 0;
    for (std::size_t i = 0; i < 60; ++i) {
        const auto person = predictParticipant(wanted, i);
        for (const auto& stimulus : person.delivery.stimuli) {
            if (stimulus.outcome != DeliveryOutcome::Presented) continue;
            ++presented;
            EXPECT_GE(stimulus.current.value(), 1.5 * person.who.detection.value() * (1 - 1e-9));
            EXPECT_LE(stimulus.current.value(), 0.8 * person.who.discomfort.value() * (1 + 1e-9));
            EXPECT_GE(stimulus.command.value(), 10 - 1e-9);
            EXPECT_LE(stimulus.command.value(), 40 + 1e-9);
        }
    }
    EXPECT_GT(presented, 60U);
}

TEST(Variation, ACancelKeepsThePeopleWhoAreDone) {
    auto wanted = options(100'000);
    wanted.trials = 1;
    wanted.threads = 3;
    std::stop_source stop;
    const auto begun = std::chrono::steady_clock::now();
    std::size_t seen = 0;
    const auto found = predictVariation(wanted, stop.get_token(), [&](std::size_t done, std::size_t total) {
                           EXPECT_EQ(total, 100'000U);
                           EXPECT_GE(done, seen);
                           seen = done;
                           if (done >= 20) stop.request_stop();
                       }).value();
    EXPECT_TRUE(found.partial);
    EXPECT_GE(found.participants, 20U);
    EXPECT_LT(found.participants, 100'000U);
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20)) << "sanitizers are slow";
    // The result so far equals a complete run with fewer people.
    wanted.participants = found.participants;
    auto whole = toJson(predictVariation(wanted).value(), wanted);
    auto part = toJson(found, wanted);
    EXPECT_EQ(part["partial"], true);
    EXPECT_EQ(whole["partial"], false);
    for (auto* one : {&whole, &part}) {
        one->erase("partial");
        one->erase("asked");
    }
    EXPECT_EQ(whole, part);

    EXPECT_THAT(predictVariation(wanted, stop.get_token()), test::refused(ErrorCode::Stopped));
}

TEST(Variation, RefusesOptionsThatMakeNoSense) {
    const auto refuses = [](auto change) {
        auto wanted = options(2);
        change(wanted);
        const auto found = predictVariation(wanted);
        ASSERT_FALSE(found);
        EXPECT_EQ(found.error().code, ErrorCode::InvalidArgument) << found.error().message;
    };
    refuses([](VariationOptions& o) { o.participants = 0; });
    refuses([](VariationOptions& o) { o.trials = 0; });
    refuses([](VariationOptions& o) { o.population.series_ohm.median = std::nan(""); });
    refuses([](VariationOptions& o) { o.population.intolerance_ma.spread = 0.9; });
    refuses([](VariationOptions& o) { o.population.attention_ma.median = 3; });
    refuses([](VariationOptions& o) { o.population.intolerance_ma.median = 6; });
    refuses([](VariationOptions& o) { o.population.discomfort_ma = 3.5; });
    refuses([](VariationOptions& o) { o.population.discomfort_ma = std::nan(""); });
    refuses([](VariationOptions& o) { o.population.thresholdCorrelation = 1.1; });
    refuses([](VariationOptions& o) { o.population.skinArea = SquareCentimetres(0); });
    refuses([](VariationOptions& o) { o.stimulation.electrodeArea = SquareCentimetres(std::nan("")); });
    refuses([](VariationOptions& o) { o.population.lapseMost = 1.5; });
    refuses([](VariationOptions& o) { o.population.noise_jnd = 0; });
    refuses([](VariationOptions& o) { o.stimulation.limits.clear(); });
    refuses([](VariationOptions& o) { o.stimulation.encoding.conditions.resize(1); });
    refuses([](VariationOptions& o) { o.stimulation.belowDiscomfort = 1.2; });
    refuses([](VariationOptions& o) { o.wanted.width = 0; });
}

TEST(IndexedWork, AThrowBecomesAnErrorAndCrossesNoThread) {
    IndexedWork work;
    work.count = 1000;
    work.threads = 4;
    work.work = [](std::size_t index) {
        if (index == 17) throw std::bad_alloc();
    };
    EXPECT_THAT(runIndexed(work, {}), test::refused(ErrorCode::Unsupported, "bad_alloc"));
}

TEST(IndexedWork, DoesEveryPieceOnce) {
    std::vector<std::atomic<int>> times(5000);
    IndexedWork work;
    work.count = times.size();
    work.threads = 8;
    work.work = [&times](std::size_t index) { ++times[index]; };
    EXPECT_EQ(runIndexed(work, {}).value(), times.size());
    for (const auto& each : times) EXPECT_EQ(each.load(), 1);
    work.count = 0;
    EXPECT_EQ(runIndexed(work, {}).value(), 0U);
}

}  // namespace
}  // namespace tacto
