// Masks: a capture inside passes, a capture outside fails and shows where, and an unknown capture does neither.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/measure/CaptureMask.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Returns a pulse that begins at its trigger, or `late_s` later.
Capture pulse(double level = 40, double late_s = 0, double rate_hz = 2e6, double start_s = 0, double noise = 0) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(start_s + 1e-3 + late_s, level));
    SyntheticRecord record;
    record.rate_hz = rate_hz;
    record.start_s = start_s;
    record.samples = static_cast<std::size_t>(5e-3 * rate_hz);
    record.noise = noise;
    auto capture = recordOf(phases, record);
    capture.trigger_s = start_s + 1e-3;
    return capture;
}

CaptureMask mask(double level = 2, double time_s = 3e-6) {
    auto made = CaptureMask::around(pulse(), {{{"V", level}}, time_s});
    EXPECT_TRUE(made);
    return *made;
}

TEST(CaptureMask, WhatRepeatsPassesWheneverItComes) {
    const auto its = mask();
    EXPECT_EQ(its.check(pulse()).verdict, MaskVerdict::Inside);
    EXPECT_EQ(its.check(pulse(40, 0, 2e6, 500.0000001, 0.3)).verdict, MaskVerdict::Inside) << "later, with noise";
    EXPECT_EQ(its.check(pulse(40, 0, 5e6)).verdict, MaskVerdict::Inside) << "other samples of the same";
    EXPECT_EQ(its.check(pulse(40, 0, 1.3e6)).verdict, MaskVerdict::Inside);
}

TEST(CaptureMask, TheBandEndsWhereItSays) {
    EXPECT_EQ(mask().check(pulse(41.9)).verdict, MaskVerdict::Inside);
    const auto high = mask().check(pulse(42.2));
    ASSERT_EQ(high.verdict, MaskVerdict::Outside);
    EXPECT_GT(high.outside, 300U);
    EXPECT_NEAR(high.worst->value, 42.2, 0.01);
    EXPECT_NEAR(high.worst->limit, 42, 0.01);
    EXPECT_EQ(high.worst->channel, "voltage");
    EXPECT_GE(high.worst->time_s, 0);
    EXPECT_LE(high.worst->time_s, 500e-6);
    // The tolerance in time is 3 µs, plus 5 % of the 2 µs edge that the level tolerance allows.
    EXPECT_EQ(mask().check(pulse(40, 2.8e-6)).verdict, MaskVerdict::Inside);
    EXPECT_EQ(mask().check(pulse(40, -2.8e-6)).verdict, MaskVerdict::Inside);
    EXPECT_EQ(mask().check(pulse(40, 3.8e-6)).verdict, MaskVerdict::Outside);
    EXPECT_EQ(mask().check(pulse(40, -3.8e-6)).verdict, MaskVerdict::Outside);
}

TEST(CaptureMask, OneSampleOutsideIsEnough) {
    auto glitch = pulse();
    glitch.channels[0].samples[7777] = -2.5F;
    const auto check = mask().check(glitch);
    ASSERT_EQ(check.verdict, MaskVerdict::Outside);
    EXPECT_EQ(check.outside, 1U);
    EXPECT_NEAR(check.worst->time_s, 7777 / 2e6 - 1e-3, 1e-9);
}

TEST(CaptureMask, WhatIsNotKnownIsNotJudged) {
    const auto its = mask();
    auto untriggered = pulse();
    untriggered.trigger_s = NAN;
    EXPECT_EQ(its.check(untriggered).verdict, MaskVerdict::NotJudged);
    EXPECT_THAT(its.check(untriggered).why, HasSubstr("trigger"));
    auto missing = pulse();
    missing.channels[0].samples[100] = NAN;
    EXPECT_EQ(its.check(missing).verdict, MaskVerdict::NotJudged);
    EXPECT_THAT(its.check(missing).why, HasSubstr("missing"));
    missing.channels[0].samples[200] = 9;
    EXPECT_EQ(its.check(missing).verdict, MaskVerdict::Outside) << "what is seen outside is outside";
    auto clipped = pulse();
    clipped.channels[0].low = -40;
    clipped.channels[0].high = 40;
    EXPECT_EQ(its.check(clipped).verdict, MaskVerdict::NotJudged) << "it may have been higher";
    auto other = pulse();
    other.channels[0].name = "probe";
    EXPECT_EQ(its.check(other).verdict, MaskVerdict::NotJudged);
    auto half = pulse();
    half.channels[0].samples.resize(4000);
    EXPECT_EQ(its.check(half).verdict, MaskVerdict::NotJudged) << "the rest may hold anything";
    auto never = pulse();
    never.start_s += 1;
    EXPECT_EQ(its.check(never).verdict, MaskVerdict::NotJudged);
}

TEST(CaptureMask, RefusesABandThatIsNone) {
    for (const double level : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        EXPECT_FALSE(CaptureMask::around(pulse(), {{{"V", level}}, 1e-6})) << level;
    }
    EXPECT_FALSE(CaptureMask::around(pulse(), {{{"V", 1}}, -1e-6}));
    EXPECT_FALSE(CaptureMask::around(pulse(), {{{"V", 1}}, NAN}));
    EXPECT_FALSE(CaptureMask::around(pulse(), {{{"A", 1}}, 1e-6})) << "no channel of it";
    EXPECT_FALSE(CaptureMask::around(pulse(), {}));
    auto untriggered = pulse();
    untriggered.trigger_s = NAN;
    EXPECT_FALSE(CaptureMask::around(untriggered, {{{"V", 1}}, 1e-6}));
}

TEST(CaptureMask, CountsWhatItJudged) {
    MaskCounts counts;
    for (const double level : {40.0, 40.5, 50.0}) counts.add(mask().check(pulse(level)));
    auto untriggered = pulse();
    untriggered.trigger_s = NAN;
    counts.add(mask().check(untriggered));
    EXPECT_EQ(counts.inside, 2U);
    EXPECT_EQ(counts.outside, 1U);
    EXPECT_EQ(counts.notJudged, 1U);
    EXPECT_EQ(counts.judged(), 3U);
}

}  // namespace
}  // namespace tacto::test
