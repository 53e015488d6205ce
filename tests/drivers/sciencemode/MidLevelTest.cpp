// Mid level repeats by itself: for bench loads, and only while somebody feeds the dead-man.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bench/StimulatorSession.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using std::chrono::milliseconds;
using testing::HasSubstr;

StimulatorSettings midLevel() {
    StimulatorSettings settings;
    settings.midLevel = true;
    settings.channel = 1;
    return settings;
}

class ScienceModeMidLevel : public testing::Test {
protected:
    [[nodiscard]] Result<void> repeat(Seconds interval = Seconds(0.5), int pulses = 1) {
        return bench_.stimulator->repeat(bench_.approved(biphasic(5, pulses), interval), interval);
    }
    void keepAliveFor(Seconds duration) {
        const Instant until = bench_.clock.now() + toInstant(duration);
        while (bench_.clock.now() < until) {
            const auto kept = bench_.stimulator->keepAlive();
            ASSERT_TRUE(kept.has_value()) << kept.error().message;
            bench_.wait(Seconds(0.25));
        }
    }
    [[nodiscard]] bool repeating() {
        return bench_.line->inspect([](auto& device, Instant now) { return device.repeating(now); });
    }
    [[nodiscard]] std::uint64_t requests(Command command) {
        return bench_.line->inspect([&](auto& device, Instant) { return device.requests(command); });
    }

    ScienceModeBench bench_{{}, midLevel()};
};

TEST_F(ScienceModeMidLevel, RepeatsWhatWasApprovedAtItsInterval) {
    RecordProperty("hazard", "H4");
    ASSERT_TRUE(repeat(Seconds(0.5), 3).has_value());
    keepAliveFor(Seconds(2.2));
    const auto pulses = bench_.line->pulseList();
    ASSERT_EQ(pulses.size(), 5U);
    for (std::size_t i = 0; i < pulses.size(); ++i) {
        EXPECT_TRUE(pulses[i].midLevel);
        EXPECT_EQ(pulses[i].channel, 1);
        EXPECT_EQ(pulses[i].points.count, 15U);
        if (i > 0) {
            EXPECT_EQ(pulses[i].onset - pulses[i - 1].onset, milliseconds(500));
        }
    }
    EXPECT_TRUE(bench_.status().delivering);
}

TEST_F(ScienceModeMidLevel, GoesSilentWithin2SecondsWithoutKeepAlive) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(repeat().has_value());
    keepAliveFor(Seconds(1));
    const Instant last = bench_.clock.now() - milliseconds(250);  // keep-alives ended here
    bench_.wait(Seconds(10));
    EXPECT_FALSE(repeating());
    EXPECT_LE(bench_.line->pulseList().back().end - last, std::chrono::seconds(2) + milliseconds(1));
    EXPECT_GE(bench_.line->pulseList().back().end - last, milliseconds(1400)) << "it would have gone on otherwise";
}

TEST_F(ScienceModeMidLevel, GoesOnFor10SecondsWithKeepAlive) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(repeat().has_value());
    keepAliveFor(Seconds(10));
    EXPECT_TRUE(repeating());
    EXPECT_GE(bench_.line->pulses(), 20U);
    EXPECT_LE(bench_.clock.now() - bench_.line->pulseList().back().onset, milliseconds(500));
}

TEST_F(ScienceModeMidLevel, EndsWithin2100MillisecondsOfAControlLoopThatHangs) {
    RecordProperty("hazard", "H2");
    SafetyGate gate(bench_.clock);
    Heartbeat heartbeat;
    StimulatorSession session(*bench_.stimulator, gate, heartbeat, bench_.clock, {});
    ASSERT_TRUE(repeat().has_value());
    const auto runFor = [&](Seconds duration, bool loopAlive) {
        const Instant until = bench_.clock.now() + toInstant(duration);
        while (bench_.clock.now() < until) {
            if (loopAlive) heartbeat.beat(bench_.clock.now());
            static_cast<void>(session.serve(bench_.clock.now()));
            bench_.wait(Seconds(0.01));
        }
    };
    runFor(Seconds(10), true);
    ASSERT_TRUE(repeating()) << "the control run goes on";
    EXPECT_GE(requests(Command::CurrentData), 39U);
    const Instant hung = bench_.clock.now();
    runFor(Seconds(5), false);
    EXPECT_FALSE(repeating());
    EXPECT_LE(bench_.line->pulseList().back().end - hung, milliseconds(2100));
}

TEST_F(ScienceModeMidLevel, ForceOffEndsIt) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(repeat(Seconds(0.1)).has_value());
    keepAliveFor(Seconds(1));
    bench_.stimulator->forceOff();
    const auto before = bench_.line->pulses();
    EXPECT_FALSE(bench_.status().delivering);
    EXPECT_TRUE(bench_.stimulator->keepAlive().has_value());
    bench_.wait(Seconds(3));
    EXPECT_EQ(bench_.line->pulses(), before);
    EXPECT_TRUE(bench_.deliver(biphasic(5)).has_value()) << "back to low level";
    EXPECT_FALSE(bench_.line->pulseList().back().midLevel);
}

TEST_F(ScienceModeMidLevel, AStopDuringTheUpdateIsRepeated) {
    RecordProperty("hazard", "H2");
    bench_.line->onWrite([&, writes = 0]() mutable {
        if (++writes == 2) bench_.stimulator->forceOff();  // ML_INIT is out, ML_UPDATE on its way
    });
    EXPECT_TRUE(repeat().has_value());
    bench_.wait(Seconds(1));
    EXPECT_FALSE(repeating());
    EXPECT_LE(bench_.line->pulses(), 1U);
}

TEST_F(ScienceModeMidLevel, KeepAliveAsksNothingInLowLevel) {
    ASSERT_TRUE(bench_.deliver(biphasic(5)).has_value());
    const auto before = bench_.line->written().size();
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(bench_.stimulator->keepAlive().has_value());
    EXPECT_EQ(bench_.line->written().size(), before);
}

TEST_F(ScienceModeMidLevel, ALiftedElectrodeIsAFaultAtTheNextKeepAlive) {
    RecordProperty("hazard", "H3");
    ASSERT_TRUE(repeat(Seconds(0.1)).has_value());
    keepAliveFor(Seconds(0.5));
    bench_.line->inspect([](auto& device, Instant now) { device.fit(Load::openCircuit(), now); });
    bench_.wait(Seconds(0.25));
    const auto told = bench_.stimulator->keepAlive();
    ASSERT_FALSE(told.has_value());
    EXPECT_THAT(told.error().message, HasSubstr("an electrode is off"));
    const auto before = bench_.line->pulses();
    bench_.wait(Seconds(2));
    EXPECT_EQ(bench_.line->pulses(), before);
    EXPECT_EQ(bench_.status().electrode, ElectrodeState::Open);
}

TEST_F(ScienceModeMidLevel, ARepetitionThatPausedByItselfIsAFault) {
    ASSERT_TRUE(repeat().has_value());
    bench_.wait(Seconds(3));
    const auto told = bench_.stimulator->keepAlive();
    ASSERT_FALSE(told.has_value());
    EXPECT_THAT(told.error().message, HasSubstr("dead-man"));
}

TEST_F(ScienceModeMidLevel, RefusesWhatItMayNotOrCannotRepeat) {
    RecordProperty("hazard", "H1");
    const auto refuses = [&](const PulseTrain& train, Seconds approvedFor, Seconds interval) {
        const auto refused = bench_.stimulator->repeat(bench_.approved(train, approvedFor), interval);
        return !refused.has_value() && refused.error().code == ErrorCode::Device;
    };
    EXPECT_TRUE(refuses(biphasic(5), Seconds(0.5), Seconds(0.4))) << "faster than approved";
    EXPECT_TRUE(refuses(biphasic(5), Seconds(0.5), Seconds(16.384))) << "does not fit the wire";
    EXPECT_TRUE(refuses(biphasic(5), Seconds(0.5), Seconds(0.5001))) << "off the grid";
    EXPECT_TRUE(refuses(biphasic(5), Seconds(0.5), Seconds(std::nan(""))));
    EXPECT_TRUE(refuses(biphasic(5, 4), Seconds(0.5), Seconds(0.5))) << "16 points hold three pulses";
    EXPECT_FALSE(repeating());
    ASSERT_TRUE(repeat().has_value());
    EXPECT_TRUE(refuses(biphasic(5), Seconds(0.5), Seconds(0.5))) << "one is running";
    EXPECT_EQ(bench_.stimulator->deliver(bench_.approved(5)).error().code, ErrorCode::Device);
}

TEST(ScienceModeLowLevel, ADeviceOpenedForLowLevelRepeatsNothing) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    const auto refused = bench.stimulator->repeat(bench.approved(biphasic(5), Seconds(0.5)), Seconds(0.5));
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), 0U);
}

}  // namespace
}  // namespace tacto::test
