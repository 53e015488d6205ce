#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/devices/Oscilloscope.h"
#include "drivers/simulated/FilteredTrace.h"
#include "tests/drivers/SimBench.h"

namespace tacto::test {
namespace {

ScopeSettings record(double rate, std::size_t samples, double level) {
    ScopeSettings settings;
    settings.sampleRate = Hertz(rate);
    settings.samples = samples;
    settings.triggerLevel = level;
    return settings;
}

TEST(SimulatedOscilloscope, TriggerTimeIsExactBetweenSamples) {
    // A straight edge of 10 V in 100 µs passes 5 V exactly 50 µs after its onset; the bandwidth adds only 8 ns.
    SimBench bench;
    bench.open("sim:oscilloscope?noise=0");
    bench.open("sim:stimulator?rise=100us&jitter=20us");
    for (int i = 0; i < 20; ++i) {
        bench.arm(record(1e5, 200, 5));
        bench.deliver(voltagePulse(10, 300));
        const auto capture = bench.capture();
        const double onset = bench.circuit().inspect(bench.clock.now(), [](const auto& p) { return p.back().onset_s; });
        EXPECT_NEAR(capture.trigger_s - onset, 50e-6, 20e-9);
        // The record must agree: straight line between the two samples around the trigger.
        const auto& v = capture.channels[0].samples;
        const double at = (capture.trigger_s - capture.start_s) * capture.rate_hz;
        const auto k = static_cast<std::size_t>(at);
        const double here = static_cast<double>(v[k]), next = static_cast<double>(v[k + 1]);
        EXPECT_NEAR(here + (at - static_cast<double>(k)) * (next - here), 5, 0.05);
    }
}

TEST(SimulatedOscilloscope, ATriggerBeforeTheForcedRecordWinsAndOneInItIsPassedOver) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator");
    auto& forced = dynamic_cast<ForcedTrigger&>(*bench.devices.oscilloscope);
    auto settings = record(1e5, 2000, 5);
    settings.preTrigger = 0.9;  // 18 ms must pass before a record can be forced
    bench.arm(settings);
    ASSERT_TRUE(forced.forceTrigger());
    bench.deliver(voltagePulse(10));
    const auto triggered = bench.capture();
    EXPECT_FALSE(triggered.untriggered);
    EXPECT_TRUE(std::isfinite(triggered.trigger_s));
    settings.preTrigger = 0.1;
    bench.arm(settings);
    bench.wait(Seconds(0.005));
    ASSERT_TRUE(forced.forceTrigger());
    bench.wait(Seconds(0.001));
    bench.deliver(voltagePulse(10));
    const auto untriggered = bench.capture();
    EXPECT_TRUE(untriggered.untriggered);
    EXPECT_TRUE(std::isnan(untriggered.trigger_s));
    EXPECT_GT(peakOf(untriggered.channels[0]), 9) << "the pulse is seen all the same";
    EXPECT_FALSE(bench.devices.oscilloscope->poll()->has_value());
}

TEST(SimulatedOscilloscope, IntervalsFromTriggerStampsAreThoseOfTheOnsets) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator?jitter=1ms");
    bench.arm(record(2e6, 2000, 2));
    double trigger = 0, onset = 0;
    for (int i = 0; i < 10; ++i) {
        bench.deliver(voltagePulse(10), Seconds(0.5));
        const auto capture = bench.capture();
        const double began = bench.circuit().inspect(bench.clock.now(), [](const auto& p) { return p.back().onset_s; });
        if (i > 0) {
            EXPECT_NEAR(capture.trigger_s - trigger, began - onset, 5e-9);
        }
        trigger = capture.trigger_s;
        onset = began;
    }
}

TEST(SimulatedOscilloscope, TriggersOnCurrentAndOnEitherPolarity) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator");
    auto settings = record(1e6, 1000, 5e-3);
    settings.triggerOnCurrent = true;
    bench.arm(settings);
    auto negative = voltagePulse(10);
    negative.polarity = Polarity::Negative;
    bench.deliver(negative);
    const auto capture = bench.capture();
    const auto after = static_cast<std::size_t>((capture.trigger_s - capture.start_s) * capture.rate_hz) + 50;
    EXPECT_NEAR(static_cast<double>(capture.channels[0].samples[after]), -10, 0.1);
    EXPECT_NEAR(static_cast<double>(capture.channels[1].samples[after]), -0.01, 5e-4);
}

TEST(SimulatedOscilloscope, BandwidthRoundsTheEdge) {
    SimBench bench;
    bench.open("sim:oscilloscope?noise=0&bandwidth=35kHz&bits=16");
    bench.open("sim:stimulator?rise=10ns");
    bench.arm(record(10e6, 4000, 0.1));
    bench.deliver(voltagePulse(10));
    const auto capture = bench.capture();
    const auto& v = capture.channels[0].samples;
    const auto firstAbove = [&](float level) {
        return std::find_if(v.begin(), v.end(), [&](float x) { return x >= level; }) - v.begin();
    };
    const double rise = static_cast<double>(firstAbove(9) - firstAbove(1)) / capture.rate_hz;
    EXPECT_NEAR(rise, 0.35 / 35e3, 0.02 * 0.35 / 35e3);
}

TEST(SimulatedOscilloscope, NoiseAndResolutionAreAsStated) {
    SimBench bench;
    bench.open("sim:oscilloscope?noise=0.001&bits=8");
    bench.open("sim:stimulator");
    bench.arm(record(1e6, 20'000, 5));
    bench.deliver(voltagePulse(10), Seconds(0.2));
    const auto capture = bench.capture();
    const auto& channel = capture.channels[0];
    EXPECT_DOUBLE_EQ(channel.lsb, 100.0 / 256);
    for (const float x : channel.samples) {
        const double code = static_cast<double>(x) / channel.lsb;
        ASSERT_NEAR(code, std::round(code), 1e-4);
    }
    SimBench fine;
    fine.open("sim:oscilloscope?noise=0.001&bits=16");
    fine.open("sim:stimulator");
    fine.arm(record(1e6, 20'000, 5));
    fine.deliver(voltagePulse(10), Seconds(0.2));
    const auto noisy = fine.capture();
    double square = 0;
    for (std::size_t i = 0; i < 1500; ++i) {
        square += std::pow(static_cast<double>(noisy.channels[0].samples[i]), 2);  // samples from before the trigger
    }
    EXPECT_NEAR(std::sqrt(square / 1500), 0.05, 0.004);
}

TEST(SimulatedOscilloscope, ClipsAtItsRange) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator");
    auto settings = record(1e6, 1000, 2);
    settings.voltageRange = Volts(8);
    bench.arm(settings);
    bench.deliver(voltagePulse(20));
    EXPECT_NEAR(peakOf(bench.capture().channels[0]), 8, 0.005);
}

TEST(SimulatedOscilloscope, ReArmsAfterEachRecordAndKeepsOrder) {
    SimBench bench;
    bench.open("sim:oscilloscope");
    bench.open("sim:stimulator?jitter=0");
    bench.arm(record(1e6, 1000, 5));
    auto train = voltagePulse(10);
    train.pulses = 5;
    bench.deliver(train, Seconds(0.2));
    double last = 0;
    for (int i = 0; i < 5; ++i) {
        const double trigger = bench.capture().trigger_s;
        if (i > 0) {
            EXPECT_NEAR(trigger - last, 0.01, 1e-8);
        }
        last = trigger;
    }
    EXPECT_FALSE(bench.devices.oscilloscope->poll()->has_value());
}

TEST(SimulatedOscilloscope, SameSeedSameBytes) {
    const auto run = [](std::uint64_t seed) {
        SimBench bench("1 kohm", seed);
        bench.open("sim:oscilloscope");
        bench.open("sim:stimulator");
        bench.arm(record(2e6, 4000, 5));
        bench.deliver(voltagePulse(10));
        return bench.capture().channels[0].samples;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

TEST(FilteredTrace, AgreesWithNumericalIntegrationOfTheFilter) {
    // Compares one pulse into the RC load through 100 kHz with small explicit steps of the same first-order filter.
    SimBench bench("200 ohm + 10 kohm || 50 nF");
    bench.open("sim:stimulator?rise=5us&latency=0&jitter=0");
    bench.deliver(voltagePulse(20));
    bench.circuit().inspect(bench.clock.now(), [](const auto& pulses) {
        const double onset = pulses[0].onset_s, end = onset + 1e-3;
        const double bandwidth = 100e3, tau = 1 / (2 * std::numbers::pi * bandwidth);
        const sim::FilteredTrace filtered(pulses, sim::FilteredTrace::Channel::Current, bandwidth, onset, end);
        const sim::FilteredTrace exact(pulses, sim::FilteredTrace::Channel::Current, 1e12, onset, end);
        std::vector<double> sampled(1000);
        filtered.sample(onset, 1e-6, sampled);
        constexpr double kStep = 2e-9;
        double y = 0;
        for (std::size_t k = 1; k < sampled.size(); ++k) {
            for (double t = onset + static_cast<double>(k - 1) * 1e-6 + kStep / 2;
                 t < onset + static_cast<double>(k) * 1e-6; t += kStep) {
                y += kStep / tau * (exact.at(t) - y);
            }
            ASSERT_NEAR(sampled[k], y, 2e-4 * 0.2) << k;
            ASSERT_NEAR(filtered.at(onset + static_cast<double>(k) * 1e-6), sampled[k], 1e-9) << k;
        }
    });
}

TEST(OscilloscopeFaults, EachFailsInItsWay) {
    const auto pulse = [](SimBench& bench) {
        bench.open("sim:stimulator");
        bench.arm(record(1e6, 1000, 5));
        bench.wait(Seconds(1));
        bench.deliver(voltagePulse(10));
        return bench.devices.oscilloscope->poll();
    };
    SimBench stale, nan, garbage, late, unplugged;
    stale.open("sim:oscilloscope?fault=stale@1s");
    EXPECT_FALSE(pulse(stale)->has_value());
    nan.open("sim:oscilloscope?fault=nan@1s");
    EXPECT_TRUE(std::isnan((*pulse(nan))->channels[0].samples[10]));
    garbage.open("sim:oscilloscope?fault=garbage@1s");
    EXPECT_EQ(pulse(garbage).error().code, ErrorCode::Device);
    late.open("sim:oscilloscope?fault=late@1s");
    EXPECT_EQ(pulse(late).error().code, ErrorCode::Timeout);
    unplugged.open("sim:oscilloscope?fault=unplug@1s");
    EXPECT_EQ(pulse(unplugged).error().code, ErrorCode::Device);
}

}  // namespace
}  // namespace tacto::test
