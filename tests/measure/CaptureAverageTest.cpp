// Means of captures: noise decreases as expected, repeated parts stay in place, and unknown values stay unknown.
#include <gtest/gtest.h>

#include "core/measure/CaptureAverage.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {
namespace {

/// Returns a capture of one triggered pulse; every capture has different noise.
std::shared_ptr<Capture> repeated(unsigned seed, double noise = 1, double late_s = 0, double level = 40) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(10 * seed + 1e-3, level));
    SyntheticRecord record;
    record.start_s = 10 * seed + late_s;
    record.samples = 10'000;
    record.noise = noise;
    record.seed = seed;
    auto capture = recordOf(phases, record);
    capture.trigger_s = 10 * seed + 1e-3;
    return std::make_shared<Capture>(std::move(capture));
}

double spread(const Capture& capture) {
    // Samples in the silence after the pulse.
    std::vector<double> silence(capture.channels[0].samples.begin() + 5000, capture.channels[0].samples.end());
    return statisticsOf(silence).sd;
}

TEST(CaptureAverage, NoiseFallsWithTheRootOfTheirNumber) {
    CaptureAverage average;
    average.setCaptures(16);
    std::shared_ptr<const Capture> mean;
    for (unsigned i = 1; i <= 16; ++i) {
        mean = average.add(repeated(i));
        EXPECT_EQ(average.count(), i);
    }
    EXPECT_NEAR(spread(*mean), 1.0 / 4, 0.02);
    EXPECT_NEAR(mean->start_s, 160, 1e-6) << "it has the time of the newest";
    const auto volts = measureChannel(*mean, 0);
    ASSERT_EQ(volts.measuredPulses, 1U);
    EXPECT_NEAR(volts.amplitude.mean, 40, 0.1);
    // From here on the newest capture has a weight of 1/16.
    for (unsigned i = 17; i <= 200; ++i) mean = average.add(repeated(i));
    EXPECT_EQ(average.count(), 16U);
    EXPECT_NEAR(spread(*mean), 1 / std::sqrt(31.0), 0.02);
}

TEST(CaptureAverage, IsAlignedAtTheTriggerToPartsOfASample) {
    CaptureAverage average;
    average.setCaptures(8);
    std::shared_ptr<const Capture> mean;
    for (unsigned i = 1; i <= 8; ++i) mean = average.add(repeated(i, 0, 0.06e-6 * i));
    EXPECT_EQ(average.count(), 8U) << "a change of less than a sample is not another setting";
    const auto volts = measureChannel(*mean, 0);
    ASSERT_EQ(volts.measuredPulses, 1U);
    EXPECT_NEAR(volts.pulses[0].leading.onset_s - mean->trigger_s, 0, 0.03e-6);
    EXPECT_NEAR(volts.width_s.mean, 200e-6, 0.05e-6);
}

TEST(CaptureAverage, OtherSettingsBeginAnew) {
    CaptureAverage average;
    average.setCaptures(8);
    const auto three = [&] {
        average.clear();
        for (unsigned i = 1; i <= 3; ++i) average.add(repeated(i));
        return average.count();
    };
    const auto after = [&](auto change) {
        EXPECT_EQ(three(), 3U);
        auto other = repeated(4);
        change(*other);
        average.add(other);
        return average.count();
    };
    EXPECT_EQ(after([](Capture&) {}), 4U);
    EXPECT_EQ(after([](Capture& c) { c.rate_hz *= 2; }), 1U);
    EXPECT_EQ(after([](Capture& c) { c.channels[0].samples.resize(9000); }), 1U);
    EXPECT_EQ(after([](Capture& c) { c.trigger_s += 1e-6; }), 1U) << "another pre-trigger";
    EXPECT_EQ(after([](Capture& c) { c.channels[0].high = 100; }), 1U);
    EXPECT_EQ(after([](Capture& c) { c.channels[0].unit = "A"; }), 1U);
    EXPECT_EQ(after([](Capture& c) { c.programmed = 30; }), 1U) << "another command";
    EXPECT_EQ(after([](Capture& c) { c.channels.push_back(c.channels[0]); }), 1U);
    three();
    average.setCaptures(4);
    EXPECT_EQ(average.count(), 0U);
}

TEST(CaptureAverage, WhatIsNotKnownIsNotAveragedAway) {
    CaptureAverage average;
    average.setCaptures(4);
    auto holed = repeated(1, 0), clipped = repeated(2, 0);
    holed->channels[0].samples[10] = NAN;
    for (auto* capture : {holed.get(), clipped.get()}) {
        capture->channels[0].low = -45;
        capture->channels[0].high = 45;
    }
    clipped->channels[0].samples[20] = 45;
    auto mean = average.add(holed);
    EXPECT_TRUE(std::isnan(mean->channels[0].samples[10]));
    mean = average.add(clipped);
    EXPECT_NEAR(mean->channels[0].samples[10], 0, 1e-6) << "of those that have it";
    EXPECT_EQ(mean->channels[0].samples[20], 45.0F) << "its true value is not known";
}

TEST(CaptureAverage, ACaptureWithoutATriggerIsShownAndNotCounted) {
    CaptureAverage average;
    average.setCaptures(4);
    average.add(repeated(1));
    auto untriggered = repeated(2);
    untriggered->trigger_s = NAN;
    EXPECT_EQ(average.add(untriggered), untriggered);
    EXPECT_EQ(average.count(), 1U);
    average.setCaptures(1);
    const auto one = repeated(3);
    EXPECT_EQ(average.add(one), one);
}

}  // namespace
}  // namespace tacto::test
