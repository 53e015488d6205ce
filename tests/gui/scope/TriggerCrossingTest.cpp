// Where the screen has its time 0: at the crossing of the trigger level, wherever the samples fall on the edge.
#include <gtest/gtest.h>

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/TriggerCrossing.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using gui::triggeredAtCrossing;

constexpr double kSample_s = 500e-9;

/// One steep pulse (an edge of 200 ns on samples 500 ns apart) whose onset lies `late` of a sample after one of them;
/// the oscilloscope states its trigger there.
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
            const auto shown = gui::prepareCapture(triggeredAtCrossing(stated, triggeredAt(8)), {}, {});
            gui::ScopeModel model;
            model.show(shown);
            EXPECT_NEAR(std::abs(model.trace("channel/voltage")->valueAt(shown->zero_s)), 8, 1e-6) << late;
            EXPECT_LT(std::abs(shown->zero_s - stated->trigger_s), kSample_s);
            furthest_s = std::max(furthest_s, std::abs(shown->zero_s - stated->trigger_s));
            EXPECT_EQ(shown->capture->start_s, stated->start_s);
            EXPECT_EQ(shown->capture->channels[0].samples, stated->channels[0].samples) << "samples stay as they are";
            const auto before = gui::prepareCapture(stated, {}, {});
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

}  // namespace
}  // namespace tacto::test
