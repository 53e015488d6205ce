// Tests the work on captures before they are drawn: calculated traces, time 0 at the crossing of the trigger level, and
// the choice of the captures on the screen and behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/ShownCaptures.h"
#include "app/gui/scope/model/Trace.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

TEST(TraceMath, PowerIsVoltageTimesCurrent) {
    const auto shown = prepared(twoPulses());
    const auto power = gui::powerTrace(*shown->traces[0], *shown->traces[1]);
    ASSERT_EQ(power->size(), 20'000U);
    for (std::size_t i = 0; i < power->size(); i += 97) {
        const float expected = (*shown->traces[0]->samples)[i] * (*shown->traces[1]->samples)[i];
        EXPECT_FLOAT_EQ((*power->samples)[i], expected);
    }
    EXPECT_EQ(power->unit, "W");
}

TEST(TraceMath, ChargeReturnsToZeroAfterABalancedPulseAndBeginsAgainAfterAGap) {
    auto capture = twoPulses();
    auto& amps = capture.channels[1].samples;
    amps[8000] = NAN;
    const auto shown = prepared(std::move(capture));
    const auto charge = gui::chargeTrace(*shown->traces[1]);
    const auto most = *std::max_element(charge->samples->begin(), charge->samples->begin() + 8000);
    EXPECT_NEAR(static_cast<double>(most), 40e-3 * 200e-6, 1e-7);
    EXPECT_NEAR(static_cast<double>((*charge->samples)[7999]), 0, 2e-8);
    EXPECT_TRUE(std::isnan((*charge->samples)[8000]));
    EXPECT_EQ((*charge->samples)[8001], 0.0F);
}

TEST(TraceMath, ADifferenceIsTakenAtTheSameTimeFromTheTrigger) {
    const auto a = prepared(twoPulses(10, 40));
    auto later = twoPulses(20, 30);
    const auto b = prepared(std::move(later));
    const auto difference = gui::differenceTrace(*a->traces[0], *b->traces[0]);
    EXPECT_NEAR(difference->valueAt(a->zero_s + 0.1e-3), 10, 0.2);
    EXPECT_NEAR(difference->valueAt(a->zero_s + 2e-3), 0, 0.2);
    // A trace at half the rate, read with straight lines between its samples.
    auto ramp = std::make_shared<std::vector<float>>();
    auto coarse = std::make_shared<std::vector<float>>();
    for (int i = 0; i < 100; ++i) ramp->push_back(static_cast<float>(i));
    for (int i = 0; i < 40; ++i) coarse->push_back(static_cast<float>(2 * i));
    const auto fine = gui::makeTrace("channel/a", "A", "V", ramp, 1000, 0, 0);
    const auto half = gui::makeTrace("channel/b", "B", "V", coarse, 500, 0, 0);
    const auto zero = gui::differenceTrace(*fine, *half);
    for (std::size_t i = 0; i <= 78; ++i) ASSERT_NEAR(static_cast<double>((*zero->samples)[i]), 0, 1e-4) << i;
    EXPECT_TRUE(std::isnan((*zero->samples)[90])) << "where one has ended there is no difference";
}

using gui::triggeredAtCrossing;

constexpr double kSample_s = 500e-9;

/// A steep pulse (edge of 200 ns, samples 500 ns apart). Its onset, which is also the stated trigger, is the fraction
/// `late` of a sample interval after a sample.
std::shared_ptr<const Capture> steepPulse(double late, double level = 40) {
    const double onset_s = 1e-3 + late * kSample_s;
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(onset_s, level, 200e-6, 100e-6, 200e-9));
    auto capture = recordOf(phases);
    capture.trigger_s = onset_s;
    return std::make_shared<const Capture>(std::move(capture));
}

ScopeSettings triggeredAt(double level) {
    ScopeSettings settings;
    settings.triggerLevel = level;
    return settings;
}

TEST(TriggerCrossing, TheEdgeCrossesTheLevelAtTime0WhereverTheSamplesFall) {
    double furthest_s = 0;
    for (const double level : {40.0, -40.0}) {
        for (double late = 0.05; late < 1; late += 0.1) {
            const auto stated = steepPulse(late, level);
            const auto shown = gui::prepareCapture(triggeredAtCrossing(stated, triggeredAt(8)));
            gui::ScopeModel model;
            model.show(shown);
            EXPECT_NEAR(std::abs(model.trace("channel/voltage")->valueAt(shown->zero_s)), 8, 1e-6) << late;
            EXPECT_LT(std::abs(shown->zero_s - stated->trigger_s), kSample_s);
            furthest_s = std::max(furthest_s, std::abs(shown->zero_s - stated->trigger_s));
            EXPECT_EQ(shown->capture->start_s, stated->start_s);
            EXPECT_EQ(shown->capture->channels[0].samples, stated->channels[0].samples) << "samples stay as they are";
            const auto before = gui::prepareCapture(stated);
            EXPECT_EQ(shown->measurement[0].pulses[0].onset_s(), before->measurement[0].pulses[0].onset_s());
            EXPECT_EQ(shown->measurement[0].width_s.mean, before->measurement[0].width_s.mean);
        }
    }
    EXPECT_GT(furthest_s, 0.4 * kSample_s) << "it mattered";
}

TEST(TriggerCrossing, WhatTheOscilloscopeStatesStaysWhereNoCrossingLiesBesideIt) {
    const auto capture = steepPulse(0.3);
    EXPECT_EQ(triggeredAtCrossing(capture, triggeredAt(60)), capture) << "a level that is not reached";
    auto elsewhere = *capture;
    elsewhere.trigger_s += 5 * kSample_s;
    const auto far = std::make_shared<const Capture>(elsewhere);
    EXPECT_EQ(triggeredAtCrossing(far, triggeredAt(8)), far);
    auto none = *capture;
    none.trigger_s = kNaN;
    const auto untriggered = std::make_shared<const Capture>(none);
    EXPECT_EQ(triggeredAtCrossing(untriggered, triggeredAt(8)), untriggered);
    auto current = triggeredAt(8);
    current.triggerOnCurrent = true;
    EXPECT_EQ(triggeredAtCrossing(capture, current), capture) << "without that channel";
    for (const double outside_s : {-1.0, 1.0}) {
        auto beyond = *capture;
        beyond.trigger_s = outside_s;
        const auto its = std::make_shared<const Capture>(beyond);
        EXPECT_EQ(triggeredAtCrossing(its, triggeredAt(8)), its) << "beside the record";
    }
}

using gui::ScopeMarks;
using gui::ShownCaptures;
using testing::IsEmpty;
using testing::SizeIs;

gui::ShownPtr benchs(double start_s) { return prepared(twoPulses(start_s)); }

gui::ShownPtr filed(double start_s) {
    auto file = std::make_shared<gui::ShownCapture>(*benchs(start_s));
    file->source = "old.csv";
    return file;
}

TEST(ShownCaptures, TheBenchsStandBehindOneAnotherAndAFileBeginsAnew) {
    ShownCaptures captures;
    const auto first = benchs(1), second = benchs(2);
    captures.show(first);
    EXPECT_THAT(captures.behind(), IsEmpty());
    EXPECT_TRUE(captures.isFollowedBy(*second));
    captures.show(second);
    EXPECT_EQ(captures.newest(), second);
    ASSERT_THAT(captures.behind(), SizeIs(1));
    EXPECT_EQ(captures.behind().front(), first);
    const auto file = filed(3);
    EXPECT_FALSE(captures.isFollowedBy(*file));
    captures.show(file);
    EXPECT_THAT(captures.behind(), IsEmpty());
    captures.show(benchs(4));
    EXPECT_THAT(captures.behind(), IsEmpty());
}

TEST(ShownCaptures, MoreStayInRollModeThanBehindAScreen) {
    ShownCaptures captures;
    captures.setRoll(true);
    for (int i = 0; i < ShownCaptures::kMaxBehind + 5; ++i) captures.show(benchs(i));
    EXPECT_THAT(captures.behind(), SizeIs(ShownCaptures::kMaxBehind + 4));
    captures.setRoll(false);
    EXPECT_THAT(captures.behind(), SizeIs(ShownCaptures::kMaxBehind));
    captures.setPersistence(1000);
    EXPECT_EQ(captures.persistence(), ShownCaptures::kMaxBehind);
}

TEST(ScopeMarks, TheOldestGo) {
    ScopeMarks marks;
    for (std::size_t i = 0; i <= ScopeMarks::kMaxKept; ++i) marks.add({static_cast<double>(i), "m"});
    EXPECT_THAT(marks.between(0, 1e9, 0), SizeIs(ScopeMarks::kMaxKept));
    EXPECT_THAT(marks.between(0, 0.5, 0), IsEmpty());
}

}  // namespace
}  // namespace tacto::test
