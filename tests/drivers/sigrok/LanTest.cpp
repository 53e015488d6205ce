// Pulses of the simulated stimulator, measured by an instrument on the network.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/measure/PulseMeasurement.h"
#include "tests/drivers/sigrok/ScopeOnLan.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

ScopeSettings lanSettings(double rate = 1e6, std::size_t samples = 7000) {
    ScopeSettings s;
    s.sampleRate = Hertz(rate);
    s.samples = samples;
    s.triggerLevel = 5;
    s.voltageRange = Volts(13);
    s.currentRange = Milliamps(13);
    return s;
}

TEST(ScopeOnLan, SaysWhoItIsAndWhatItCan) {
    ScopeOnLan lan;
    const auto& identity = lan.scope().identity();
    EXPECT_EQ(identity.name, "Rigol DS2072A");
    EXPECT_EQ(identity.serial, "DS2D0000000032");
    EXPECT_EQ(identity.uri, lan.uri());
    EXPECT_FALSE(identity.simulated) << "nothing in the conversation says that it is emulated";
    EXPECT_EQ(lan.scope().traits().memoryDepth, 7000U);
    EXPECT_DOUBLE_EQ(lan.scope().traits().maxRate.value(), 500e6);
}

TEST(ScopeOnLan, APulseHasItsAmplitudeWidthAndInterval) {
    ScopeOnLan lan;
    auto two = voltagePulse(10);  // into 1 kohm, which makes 10 mA
    two.pulses = 2;
    two.rate = Hertz(400);
    lan.arm(lanSettings());
    lan.bench().deliver(two, Seconds(0));
    lan.pass(Seconds(0.06));
    const auto capture = lan.poll();
    ASSERT_IN_TIME(capture);
    ASSERT_IN_TIME(capture->has_value());
    ASSERT_EQ((*capture)->channels.size(), 2U);
    const double lsb_V = 5 / 25.0;  // 5 V per division
    EXPECT_NEAR((*capture)->channels[0].lsb, lsb_V, 1e-6);
    const auto volts = measureChannel(**capture, 0);
    ASSERT_EQ(volts.measuredPulses, 2U) << testing::PrintToString(volts.warnings);
    EXPECT_NEAR(volts.amplitude.mean, 10, lsb_V / 2);
    EXPECT_NEAR(volts.width_s.mean, 200e-6, 1e-6);
    EXPECT_NEAR(volts.interval_s.mean, 2.5e-3, 1e-6);
    const auto amps = measureChannel(**capture, 1);
    ASSERT_EQ(amps.measuredPulses, 2U) << testing::PrintToString(amps.warnings);
    const double lsb_A = 0.05 / 25 / ScopeOnLan::kShuntOhm;  // 0.13 V of range: 50 mV per division
    EXPECT_NEAR((*capture)->channels[1].lsb, lsb_A, 1e-9);
    EXPECT_NEAR(amps.amplitude.mean, 0.01, lsb_A / 2);
    EXPECT_NEAR(amps.width_s.mean, 200e-6, 1e-6);
    EXPECT_NEAR(amps.charge.mean, 2e-6, 2e-8);
}

TEST(ScopeOnLan, ManyTriggersGiveManyCaptures) {
    ScopeOnLan lan;
    lan.arm(lanSettings(1e6, 2000));
    double last = -1;
    for (int i = 0; i < 5; ++i) {
        ASSERT_IN_TIME(lan.instrument().waits(Seconds(5)));
        lan.bench().wait(Seconds(0.02));
        lan.bench().deliver(voltagePulse(10), Seconds(0));
        lan.pass(Seconds(0.06));
        const auto capture = lan.poll();
        ASSERT_IN_TIME(capture);
        ASSERT_IN_TIME(capture->has_value()) << i;
        EXPECT_GT((*capture)->trigger_s, last);
        last = (*capture)->trigger_s;
        EXPECT_NEAR(((*capture)->trigger_s - (*capture)->start_s) * 1e6, 200, 1.0);
    }
}

TEST(ScopeOnLan, PulsesThatBeginNegativeTriggerWithSlopeFall) {
    ScopeOnLan lan("&slope=fall");
    lan.arm(lanSettings(1e6, 2000));
    auto pulse = voltagePulse(10);
    pulse.polarity = Polarity::Negative;
    lan.bench().deliver(pulse, Seconds(0));
    lan.pass(Seconds(0.06));
    const auto capture = lan.poll();
    ASSERT_IN_TIME(capture.has_value() && capture->has_value());
    EXPECT_NEAR(((*capture)->trigger_s - (*capture)->start_s) * 1e6, 200, 1.0);
    EXPECT_LT((*capture)->channels[0].samples[250], -9.0F);
}

TEST(ScopeOnLan, ProbesCouplingScaleAndTriggerReachTheInstrument) {
    ScopeOnLan lan("&probe=10");
    auto s = lanSettings(1e6, 2000);
    s.triggerOnCurrent = true;
    s.triggerLevel = 0.005;
    lan.arm(s);
    const auto heard = lan.instrument().heard();
    for (const char* command : {":CHAN1:PROB 10", ":CHAN1:COUP DC", ":CHAN2:COUP DC", ":CHAN1:SCAL 5.000",
                                ":CHAN2:SCAL 0.050", ":TRIG:EDGE:SOUR CHAN2", ":TRIG:EDGE:SLOP POS",
                                ":TRIG:EDGE:LEV 0.050", ":TIM:SCAL 0.000500000", ":ACQ:MDEP 7000", ":SING"}) {
        EXPECT_THAT(heard, testing::Contains(command));
    }
    lan.bench().deliver(voltagePulse(10), Seconds(0));
    lan.pass(Seconds(0.06));
    EXPECT_IN_TIME(lan.poll()->has_value());
}

TEST(ScopeOnLan, LiveGivesEachRecordOnce) {
    ScopeOnLan lan("&record=live");
    auto s = lanSettings(200e3, 1400);  // 1400 samples over 7 ms
    lan.arm(s);
    lan.bench().deliver(voltagePulse(10), Seconds(0.06));
    const auto first = lan.poll();
    ASSERT_IN_TIME(first);
    ASSERT_IN_TIME(first->has_value());
    EXPECT_NEAR(measureChannel(**first, 0).amplitude.mean, 10, 0.1);
}

}  // namespace
}  // namespace tacto::test
