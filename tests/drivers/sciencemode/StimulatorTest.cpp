// The ScienceMode driver on the emulated device: identification, pulses sent, answers received.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using std::chrono::milliseconds;
using testing::HasSubstr;

EmulatedSettings onLoad(const Load& load) {
    EmulatedSettings settings;
    settings.load = load;
    return settings;
}

void misbehave(ScienceModeBench& bench, AckFault fault, int times = 1) {
    bench.line->inspect([&](auto& device, Instant) { device.misbehave(fault, times); });
}

void setLoad(ScienceModeBench& bench, const Load& load) {
    bench.line->inspect([&](auto& device, Instant now) { device.fit(load, now); });
}

/// Expects eight pulses with at least 9 ms from onset to onset.
void expectEightNoneTooSoon(ScienceModeBench& bench) {
    const auto pulses = bench.line->pulseList();
    ASSERT_EQ(pulses.size(), 8U);
    for (std::size_t i = 1; i < pulses.size(); ++i) {
        EXPECT_GE(pulses[i].onset - pulses[i - 1].onset, milliseconds(9)) << i;
    }
}

/// Opens the device on `line` as `wanted`; returns whether that succeeds.
Result<void> opens(const std::shared_ptr<EmulatedLine>& line, const Clock& clock, std::string_view wanted = {}) {
    const auto opened = ScienceModeStimulator::open(line->connector(), "sciencemode:", wanted, {}, clock);
    if (!opened) return failure(opened);
    return {};
}

// --- identification --------------------------------------------------------------------------------------------------

TEST(ScienceModeOpen, SaysWhoAnswered) {
    RecordProperty("hazard", "H4");
    EmulatedSettings device;
    device.id = "P24-000123";
    device.firmware = {1, 4, 2};
    const ScienceModeBench bench(device);
    const auto& identity = bench.stimulator->identity();
    EXPECT_EQ(identity.serial, "P24-000123");
    EXPECT_EQ(identity.firmware, "1.4.2, ScienceMode 4.0.0");
    EXPECT_EQ(identity.role, Role::Stimulator);
}

TEST(ScienceModeOpen, RefusesADeviceThatIsNotWhatItShouldBe) {
    RecordProperty("hazard", "H4");
    VirtualClock clock;
    EmulatedSettings settings;
    for (const auto& [id, major, wanted, code] : {std::tuple{"EMU0000001", 4, "EMU0000002", ErrorCode::NotFound},
                                                  {"EMU0000001", 5, "", ErrorCode::Device},
                                                  {"EMU0000001", 0, "", ErrorCode::Device},
                                                  {"", 4, "", ErrorCode::Device},
                                                  {"\x01\x02", 4, "", ErrorCode::Device}}) {
        settings.id = id;
        settings.protocol.major = static_cast<std::uint8_t>(major);
        const auto line = std::make_shared<EmulatedLine>(clock, &clock, settings);
        EXPECT_THAT(opens(line, clock, wanted), refused(code)) << id << major;
        EXPECT_LE(line->written().size(), 2U) << "it was asked who it is, and left alone";
    }
}

TEST(ScienceModeOpen, RefusesAThingThatSpeaksSomethingElse) {
    RecordProperty("hazard", "H4");
    VirtualClock clock;
    const auto line = std::make_shared<EmulatedLine>(clock, &clock);
    line->inspect([](auto& device, Instant) { device.talkGarbage(100); });
    EXPECT_EQ(opens(line, clock).error().code, ErrorCode::Device);
    const auto silent = std::make_shared<EmulatedLine>(clock, &clock);
    silent->inspect([](auto& device, Instant) { device.misbehave(AckFault::Drop, 100); });
    EXPECT_EQ(opens(silent, clock).error().code, ErrorCode::Timeout);
    const auto nothing = std::make_shared<EmulatedLine>(clock, &clock);
    nothing->unplug();
    EXPECT_EQ(opens(nothing, clock).error().code, ErrorCode::NotFound);
}

TEST(ScienceModeOpen, EndsWhateverTheDeviceWasDoing) {
    RecordProperty("hazard", "H2");
    VirtualClock clock;
    const auto line = std::make_shared<EmulatedLine>(clock, &clock);
    line->inspect(startRepeating);
    ASSERT_TRUE(line->inspect([](auto& device, Instant now) { return device.repeating(now); }));
    ASSERT_TRUE(opens(line, clock).has_value());
    EXPECT_FALSE(line->inspect([](auto& device, Instant now) { return device.repeating(now); }));
}

// --- pulses sent -----------------------------------------------------------------------------------------------------

TEST(ScienceModeDeliver, EachParameterArrivesInItsOwnPlace) {
    RecordProperty("hazard", "H4");
    for (int channel = 0; channel < 4; ++channel) {
        for (int connector = 0; connector < 2; ++connector) {
            StimulatorSettings settings;
            settings.channel = channel;
            settings.connector = connector;
            ScienceModeBench bench({}, settings);
            PulseTrain train = biphasic(7.5 + channel);
            train.polarity = connector == 0 ? Polarity::Positive : Polarity::Negative;
            train.phaseWidth = Micros(300 + channel);
            train.interPhaseGap = Micros(50);
            ASSERT_TRUE(bench.deliver(train).has_value());
            const auto pulses = bench.line->pulseList();
            ASSERT_EQ(pulses.size(), 1U);
            EXPECT_EQ(pulses[0].channel, 4 * connector + channel);
            const double lead = (7.5 + channel) * (connector == 0 ? 1 : -1);
            ASSERT_EQ(pulses[0].points.count, 3U);
            EXPECT_EQ(pulses[0].points.items[0], (Point{train.phaseWidth, Milliamps(lead)}));
            EXPECT_EQ(pulses[0].points.items[1], (Point{Micros(50), Milliamps(0)}));
            EXPECT_EQ(pulses[0].points.items[2], (Point{train.phaseWidth, Milliamps(-lead)}));
        }
    }
}

TEST(ScienceModeDeliver, PulsesFollowEachOtherAtTheTrainsRate) {
    for (const double rate : {20.0, 100.0, 250.0}) {
        ScienceModeBench bench;
        ASSERT_TRUE(bench.deliver(biphasic(5, 10, rate)).has_value());
        const auto pulses = bench.line->pulseList();
        ASSERT_EQ(pulses.size(), 10U) << rate;
        for (std::size_t i = 1; i < pulses.size(); ++i) {
            EXPECT_NEAR(toSeconds(pulses[i].onset - pulses[i - 1].onset), 1 / rate, 1e-6);
        }
        EXPECT_EQ(bench.status().trainsDelivered, 1U);
    }
}

TEST(ScienceModeDeliver, HundredsOfPulsesGoThroughEveryPacketNumber) {
    ScienceModeBench bench;
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(bench.deliver(biphasic(5, 10)).has_value());
    EXPECT_EQ(bench.line->pulses(), 200U);
    EXPECT_EQ(bench.status().trainsDelivered, 20U);
    EXPECT_EQ(bench.stimulator->counts().junkBytes, 0U);
}

TEST(ScienceModeDeliver, RefusesWithoutAByteOnTheWire) {
    RecordProperty("hazard", "H1");
    ScienceModeBench bench;
    // A gate that assumes a finer device approves a train that this device cannot play.
    SourceTraits finer = bench.stimulator->traits();
    finer.amplitudeStep = 0;
    finer.amplitudeMax = 500;
    finer.currentLimit = Milliamps(500);
    finer.widthStep = Micros(0);
    finer.widthMax = Micros(9000);
    const auto gate = benchGate(bench.clock, finer);
    const auto before = bench.line->written().size();
    auto odd = biphasic(5.3);
    auto strong = biphasic(131);
    auto uneven = biphasic(5);
    uneven.phaseWidth = Micros(200.5);
    auto wide = biphasic(5, 1, 20);
    wide.phaseWidth = Micros(5000);
    for (const auto& train : {odd, strong, uneven, wide}) {
        EXPECT_THAT(bench.stimulator->deliver(approve(*gate, bench.clock, train, Seconds(2))),
                    refused(ErrorCode::Device));
    }
    EXPECT_EQ(bench.line->written().size(), before);
    EXPECT_EQ(bench.line->pulses(), 0U);
}

TEST(ScienceModeDeliver, RefusesATrainWhileOneIsInProgress) {
    RecordProperty("hazard", "H1");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 20)).has_value());
    bench.wait(Seconds(0.05));
    EXPECT_THAT(bench.stimulator->deliver(bench.approved(5)), refused(ErrorCode::Device));
    bench.wait(Seconds(0.2));
    EXPECT_EQ(bench.line->pulses(), 20U);
}

TEST(ScienceModeDeliver, AHostThatIsALittleLateNeverHurriesAfterwards) {
    RecordProperty("hazard", "H1");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 8)).has_value());
    for (int i = 0; i < 8; ++i) {
        const Instant next = bench.stimulator->serve(bench.clock.now());
        if (next == Instant::max()) break;
        bench.clock.advanceTo(next + milliseconds(i % 2 == 0 ? 4 : 0));
    }
    bench.wait(Seconds(0.1));
    expectEightNoneTooSoon(bench);
}

TEST(ScienceModeDeliver, APulseHeldUpOnItsWayToTheWireIsNotFollowedTooFast) {
    RecordProperty("hazard", "H1");
    int writes = 0;  // declared before the bench, which writes until it is destroyed
    ScienceModeBench bench;
    bench.line->onWrite([&] {
        if (++writes % 2 == 0) bench.clock.advanceTo(bench.clock.now() + milliseconds(4));
    });
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 8)).has_value());
    bench.wait(Seconds(0.2));
    expectEightNoneTooSoon(bench);
}

TEST(ScienceModeDeliver, SmallSlipsDoNotAddUpUntilTheTrainIsGivenUp) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    const auto train = biphasic(5, 60, 100);
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(train)).has_value());
    const Instant planned = bench.clock.now() + toInstant(train.duration());
    Instant told{0};
    for (;;) {
        const Instant next = bench.stimulator->serve(bench.clock.now());
        if (next == Instant::max()) break;
        if (const auto status = bench.status(); status.delivering) told = status.trainEnd.value_or(Instant(0));
        bench.clock.advanceTo(next + std::chrono::microseconds(1600));
    }
    EXPECT_EQ(bench.line->pulses(), 60U);
    const Instant end = bench.line->pulseList().back().end;
    EXPECT_GT(end, planned + milliseconds(80)) << "each pulse moves those after it";
    EXPECT_NEAR(toSeconds(told - end), 0, 0.005) << "and the status says when the train ends";
    EXPECT_FALSE(bench.status().delivering);
}

TEST(ScienceModeDeliver, AComputerThatSleptGivesTheTrainUp) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    const auto before = bench.line->pulses();
    bench.clock.sleepFor(std::chrono::seconds(3));  // meanwhile the steady clock does not advance
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), before);
    EXPECT_FALSE(bench.stimulator->status().has_value());
}

TEST(ScienceModeDeliver, AHostThatSleptGivesTheTrainUp) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    const auto before = bench.line->pulses();
    bench.clock.advanceTo(bench.clock.now() + std::chrono::seconds(3));  // suspended, or stopped in a debugger
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), before);
    const auto status = bench.stimulator->status();
    ASSERT_FALSE(status.has_value());
    EXPECT_EQ(status.error().code, ErrorCode::Timeout);
    EXPECT_THAT(status.error().message, HasSubstr("abandoned"));
    EXPECT_TRUE(bench.stimulator->status().has_value()) << "it is reported once";
}

// --- answers received ------------------------------------------------------------------------------------------------

TEST(ScienceModeStatus, ReadsTheImpedanceOfTheBenchLoadsBack) {
    for (const auto& [name, load] : benchLoads()) {
        if (load.kind == LoadKind::Open || load.kind == LoadKind::Short) continue;
        ScienceModeBench bench(onLoad(load));
        // The impedance check: the device's smallest pulse.
        ASSERT_TRUE(bench.deliver(biphasic(0.5)).has_value());
        const auto status = bench.status();
        const double wanted = effectiveImpedance(load, {Drive::Current, 5e-4, 5e-4, 200e-6}).value();
        EXPECT_EQ(status.electrode, ElectrodeState::Ok) << name;
        ASSERT_TRUE(status.impedance.has_value()) << name;
        EXPECT_NEAR(status.impedance->value(), wanted, 0.01 * wanted + 25) << name;
        EXPECT_FALSE(status.amplitude.has_value()) << "the current was not measured";
        EXPECT_FALSE(status.imbalance.has_value()) << "magnitudes cannot tell";
    }
}

TEST(ScienceModeStatus, MeasuresTheAmplitudeWhereThatIsWhatItWasOpenedFor) {
    StimulatorSettings settings;
    settings.measurement = Measurement::Current;
    ScienceModeBench bench({}, settings);
    EXPECT_FALSE(bench.stimulator->traits().readsBack);
    ASSERT_TRUE(bench.deliver(biphasic(12.5)).has_value());
    const auto status = bench.status();
    ASSERT_TRUE(status.amplitude.has_value());
    EXPECT_NEAR(*status.amplitude, 12.5, 0.01);
    EXPECT_FALSE(status.impedance.has_value());
}

TEST(ScienceModeStatus, ALiftedElectrodeEndsTheTrainAtThatPulse) {
    RecordProperty("hazard", "H3");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    ASSERT_EQ(bench.status().electrode, ElectrodeState::Ok);
    const auto before = bench.line->pulses();
    setLoad(bench, Load::openCircuit());
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), before + 1) << "the one that found it";
    const auto status = bench.status();
    EXPECT_EQ(status.electrode, ElectrodeState::Open);
    EXPECT_FALSE(status.delivering);
    EXPECT_FALSE(status.impedance.has_value());
}

/// A later good pulse must not hide the fault.
TEST(ScienceModeStatus, NoPulseFollowsOneThatFoundNoElectrode) {
    RecordProperty("hazard", "H3");
    for (const auto& load : {Load::openCircuit(), Load::shortCircuit(), Load::resistor(Ohms(5))}) {
        for (const int good : {1, 2, 3, 4}) {
            ScienceModeBench bench;
            ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 6)).has_value());
            bench.wait(Seconds(0.01 * (good - 1) + 0.004));
            ASSERT_EQ(bench.line->pulses(), std::size_t(good));
            setLoad(bench, load);
            bench.wait(Seconds(0.01));
            setLoad(bench, Load::resistor(Ohms(1000)));
            bench.wait(Seconds(0.2));
            EXPECT_EQ(bench.line->pulses(), std::size_t(good) + 1) << "the one that found it";
            const auto found = bench.status().electrode;
            EXPECT_TRUE(found == ElectrodeState::Open || found == ElectrodeState::Short);
        }
    }
}

TEST(ScienceModeStatus, AShortIsTold) {
    RecordProperty("hazard", "H3");
    ScienceModeBench bench(onLoad(Load::shortCircuit()));
    ASSERT_TRUE(bench.deliver(biphasic(5)).has_value());
    EXPECT_EQ(bench.status().electrode, ElectrodeState::Short);
}

TEST(ScienceModeStatus, ACurrentThatIsNotReachedIsAFaultWithItsReason) {
    RecordProperty("hazard", "H3");
    ScienceModeBench bench(onLoad(Load::resistor(Ohms(100'000))));
    EXPECT_THAT(bench.stimulator->deliver(bench.approved(5)), refused(ErrorCode::Device, "did not reach its current"));
}

// --- a faulty device -------------------------------------------------------------------------------------------------

TEST(ScienceModeFaults, AFirstPulseWithoutASoundAckFailsTheDelivery) {
    RecordProperty("hazard", "H10");
    for (const auto& [fault, code, text] : {std::tuple{AckFault::Drop, ErrorCode::Timeout, "did not answer"},
                                            {AckFault::Delay, ErrorCode::Timeout, "did not answer"},
                                            {AckFault::WrongCrc, ErrorCode::Device, "garbage"},
                                            {AckFault::WrongNumber, ErrorCode::Timeout, "did not answer"},
                                            {AckFault::Truncated, ErrorCode::Device, "260 bytes"},
                                            {AckFault::Refused, ErrorCode::Device, "result 4"},
                                            {AckFault::WrongChannel, ErrorCode::Device, "channel 1"}}) {
        ScienceModeBench bench;
        misbehave(bench, fault);
        EXPECT_THAT(bench.stimulator->deliver(bench.approved(5, 10)), refused(code, text)) << text;
        bench.stimulator->forceOff();  // as the session would do
        bench.wait(Seconds(0.2));
        EXPECT_EQ(bench.line->pulses(), 1U) << "no more pulses follow";
        EXPECT_TRUE(bench.deliver(biphasic(5)).has_value()) << "a good device is taken up again";
    }
}

TEST(ScienceModeFaults, DuplicatesAndJunkAreNoFaults) {
    for (const auto fault : {AckFault::Duplicate, AckFault::Junk}) {
        ScienceModeBench bench;
        misbehave(bench, fault, 100);
        ASSERT_TRUE(bench.deliver(biphasic(5, 20)).has_value());
        EXPECT_EQ(bench.status().electrode, ElectrodeState::Ok);
        EXPECT_EQ(bench.line->pulses(), 20U);
    }
}

TEST(ScienceModeFaults, AMissingAckInMidTrainStopsItThereAndIsTold) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    const auto before = bench.line->pulses();
    misbehave(bench, AckFault::Drop);
    bench.wait(Seconds(1));
    EXPECT_EQ(bench.line->pulses(), before + 1);
    EXPECT_EQ(bench.line->inspect([](auto& device, Instant now) { return device.state(now); }), Stimulation::None)
        << "it was stopped";
    EXPECT_THAT(bench.stimulator->status(), refused(ErrorCode::Timeout));
    EXPECT_FALSE(bench.status().delivering);
}

TEST(ScienceModeFaults, UnpluggedInMidTrainFaultsAndComesBackByIdentity) {
    RecordProperty("hazard", "H2");
    ScienceModeBench bench;
    ASSERT_TRUE(bench.stimulator->deliver(bench.approved(5, 50)).has_value());
    bench.wait(Seconds(0.1));
    bench.line->unplug();
    bench.wait(Seconds(0.1));
    EXPECT_EQ(bench.stimulator->status().error().code, ErrorCode::Device);
    EXPECT_FALSE(bench.stimulator->status().has_value()) << "it is still away";
    EXPECT_FALSE(bench.stimulator->keepAlive().has_value());
    bench.line->plug();
    EXPECT_EQ(bench.stimulator->deliver(bench.approved(5)).error().code, ErrorCode::Device)
        << "only asking how it is takes it up again";
    const auto status = accepted(bench.stimulator->status());
    EXPECT_FALSE(status.delivering);
    EXPECT_TRUE(bench.deliver(biphasic(5)).has_value());
}

TEST(ScienceModeFaults, AnotherDeviceInTheSameSocketIsNotTaken) {
    RecordProperty("hazard", "H4");
    ScienceModeBench bench;
    bench.line->unplug();
    ASSERT_FALSE(bench.stimulator->deliver(bench.approved(5)).has_value());
    EmulatedSettings other;
    other.id = "EMU0000099";
    bench.line->plugAnother(other);
    EXPECT_THAT(bench.stimulator->status(), refusedSaying("EMU0000099"));
    EXPECT_FALSE(bench.stimulator->deliver(bench.approved(5)).has_value());
    EXPECT_EQ(bench.line->pulses(), 0U);
}

}  // namespace
}  // namespace tacto::test
