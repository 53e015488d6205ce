// PulsePalStimulator on the emulated device: its output, the firmware's traps, and every way in which output must end.
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/pulsepal/PulsePalLine.h"
#include "tests/support/Allocations.h"
#include "tests/support/BenchGate.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using pulsepal::Parameter;
using pulsepal::PulsePalStimulator;
using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kTrigger = 0x4D, kAbort = 0x50, kContinuous = 0x52;

class PulsePal : public testing::Test {
protected:
    PulsePalBench bench;
    std::uint64_t commands(std::uint8_t code) {
        bench.wait(Seconds(0.001));  // the device takes one command per 50 µs
        return bench.line->inspect([&](auto& device, Instant now) {
            static_cast<void>(device.active(now));
            return device.commands(code);
        });
    }
};

TEST_F(PulsePal, ATrainIsDeliveredAsApprovedOnItsOwnChannelOnly) {
    RecordProperty("hazard", "H4");
    PulsePalBench third(3);
    ASSERT_TRUE(third.deliver(pulseTrain(5, 2, 50)));
    third.wait(Seconds(0.1));
    const auto phases = third.line->phases();
    ASSERT_EQ(phases.size(), 4u);
    for (const auto& phase : phases) EXPECT_EQ(phase.channel, 3);
    EXPECT_NEAR(phases[0].volts.value(), 5, 4e-4);
    EXPECT_EQ(phases[0].end - phases[0].begin, std::chrono::microseconds(200));
    EXPECT_EQ(phases[2].begin - phases[0].begin, std::chrono::milliseconds(20));
    EXPECT_EQ(third.stimulator->identity().firmware, "21");
}

TEST_F(PulsePal, OpeningQuietsEveryChannelAndIntroducesItself) {
    RecordProperty("hazard", "H2");
    EXPECT_EQ(commands(kTrigger), 0u);
    bench.line->inspect([](auto& device, Instant) {
        EXPECT_EQ(device.clientName(), "TACTO ");
        EXPECT_GE(device.commands(kAbort), 2u);
        for (int channel = 1; channel <= pulsepal::kChannels; ++channel) {
            EXPECT_EQ(device.stored(Parameter::LinkTrigger1, channel), 0u);
            EXPECT_EQ(device.stored(Parameter::RestingVoltage, channel), 32768u);
        }
    });
}

TEST_F(PulsePal, OneTransferForEachCommandAndNeverContinuousMode) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(bench.deliver(pulseTrain(5, 3)));
    bench.wait(Seconds(0.1));
    static_cast<void>(bench.status());
    bench.stimulator.reset();
    for (const auto& transfer : bench.line->written()) {
        ASSERT_EQ(transfer.at(0), 0xD5);
        EXPECT_NE(transfer.at(1), kContinuous);
        // A transfer must be one whole command; only the double abort is two.
        const auto again = std::find(transfer.begin() + 1, transfer.end(), std::uint8_t{0xD5});
        EXPECT_TRUE(again == transfer.end() || transfer == (Bytes{0xD5, 0x50, 0xD5, 0x50}) || transfer.at(1) == 0x4A);
    }
    EXPECT_EQ(commands(kContinuous), 0u);
    EXPECT_FALSE(bench.line->inspect([](auto& device, Instant now) { return device.frozen(now); }));
}

TEST_F(PulsePal, EachTrainIsProgrammedAsAWholeSoThatTheJoystickCannotChangeIt) {
    RecordProperty("hazard", "H1");
    ASSERT_TRUE(bench.deliver(pulseTrain(2)));
    bench.wait(Seconds(0.1));
    bench.line->inspect([](auto& device, Instant now) {
        const auto loud =
            set(pulsepal::Voltage::Phase1, *pulsepal::Channel::of(1), *pulsepal::VoltageCode::of(Volts(10)));
        device.receive(loud.view(), now);
    });
    ASSERT_TRUE(bench.deliver(pulseTrain(2)));
    bench.wait(Seconds(0.1));
    for (const auto& phase : bench.line->phases()) EXPECT_LE(std::abs(phase.volts.value()), 2);
}

TEST_F(PulsePal, ASecondTrainWaitsForTheEndOfTheFirst) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 10)));
    bench.wait(Seconds(0.02));
    EXPECT_THAT(bench.deliver(pulseTrain(2)), refusedSaying("in progress"));
    EXPECT_EQ(commands(kTrigger), 1u);
    bench.wait(Seconds(0.1));
    EXPECT_TRUE(bench.deliver(pulseTrain(2)));
}

TEST_F(PulsePal, ATriggerThatIsKeptDuringATrainDoesNotSurviveTheStop) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 50)));
    bench.wait(Seconds(0.02));
    // Another program's trigger, which the firmware keeps while the train runs.
    bench.line->inspect([](auto& device, Instant now) { device.receive(pulsepal::trigger(1).view(), now); });
    bench.wait(Seconds(0.001));
    bench.stimulator->forceOff();
    bench.wait(Seconds(0.001));
    EXPECT_FALSE(bench.line->active());
    bench.wait(Seconds(2));
    EXPECT_FALSE(bench.line->active());
}

TEST(PulsePalFirmware, OneAbortIsNotEnoughForAKeptTrigger) {
    // Shows why the driver sends two aborts: the emulated firmware really behaves like this.
    RecordProperty("hazard", "H2");
    for (const bool twice : {false, true}) {
        VirtualClock clock;
        const auto line = std::make_shared<PulsePalLine>(clock, &clock);
        auto opened = accepted(PulsePalStimulator::open(line->connector(), "pulsepal:S", "S", 1, clock));
        const auto gate = benchGate(clock, opened->traits());
        ASSERT_TRUE(opened->deliver(approve(*gate, clock, pulseTrain(2, 50))));
        clock.advanceTo(clock.now() + Instant(std::chrono::milliseconds(20)));
        line->inspect([&](auto& device, Instant now) {
            device.receive(pulsepal::trigger(1).view(), now);
            device.receive((twice ? pulsepal::abortTwice() : pulsepal::abort()).view(), now);
        });
        clock.advanceTo(clock.now() + Instant(std::chrono::milliseconds(5)));
        EXPECT_EQ(line->active(), !twice);
    }
}

TEST_F(PulsePal, AStopThatComesBeforeTheTriggerIsRepeatedBehindIt) {
    RecordProperty("hazard", "H2");
    // The stop is sent before a trigger that was already decided.
    bench.line->onWrite([&](std::span<const std::uint8_t> bytes) {
        if (bytes[1] == kTrigger) bench.stimulator->forceOff();
    });
    EXPECT_TRUE(bench.deliver(pulseTrain(2, 50)));
    bench.line->onWrite({});
    EXPECT_EQ(commands(kTrigger), 1u);
    EXPECT_FALSE(bench.line->active());
    EXPECT_FALSE(bench.status().delivering);
    for (const auto& phase : bench.line->phases()) EXPECT_LE(phase.end - phase.begin, std::chrono::microseconds(100));
}

TEST_F(PulsePal, AStopWhileItIsProgrammedKeepsTheTriggerBack) {
    RecordProperty("hazard", "H2");
    bench.line->onWrite([&, once = true](std::span<const std::uint8_t> bytes) mutable {
        if (bytes[1] == 0x4A && std::exchange(once, false)) bench.stimulator->forceOff();
    });
    EXPECT_TRUE(bench.deliver(pulseTrain(2, 50)));
    EXPECT_EQ(commands(kTrigger), 0u);
    EXPECT_TRUE(bench.line->phases().empty());
}

TEST_F(PulsePal, AContinuousModeThatWasLeftOnEndsWithTheFirstStatus) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 2)));
    bench.wait(Seconds(0.1));
    static_cast<void>(bench.status());
    bench.line->inspect([](auto& device, Instant now) {
        device.setContinuous(1, true, now);
        device.receive(pulsepal::abortTwice().view(), now + Instant(std::chrono::milliseconds(1)));
    });
    bench.wait(Seconds(0.01));
    ASSERT_FALSE(bench.line->active());
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 2)));
    bench.wait(Seconds(0.04));
    EXPECT_TRUE(bench.line->active());  // past the train's programmed end
    EXPECT_FALSE(bench.status().delivering);
    EXPECT_FALSE(bench.line->active());
}

TEST_F(PulsePal, ForceOffAllocatesNothing) {
    RecordProperty("hazard", "H2");
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    // Uses its own transport, because the emulated one stores what is written.
    struct Sink final : Transport {
        int urgent = 0;
        std::deque<std::uint8_t> answer;
        Result<void> write(std::span<const std::uint8_t> bytes, Seconds) override {
            if (bytes[1] == 0x48) answer.insert(answer.end(), {0x4B, 21, 0, 0, 0});
            if (bytes[1] == 0x4A) answer.push_back(0x01);
            return {};
        }
        Result<std::size_t> read(std::span<std::uint8_t> into, Seconds) override {
            if (answer.empty()) return fail(ErrorCode::Timeout, "nothing");
            const auto count = std::min(into.size(), answer.size());
            std::copy_n(answer.begin(), count, into.begin());
            answer.erase(answer.begin(), answer.begin() + static_cast<std::ptrdiff_t>(count));
            return count;
        }
        std::uint64_t dropped() const noexcept override { return 0; }
        void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override {
            urgent += static_cast<int>(bytes.size());
        }
    };
    auto sink = std::make_unique<Sink>();
    const auto& seen = *sink;
    auto opened = accepted(PulsePalStimulator::open(
        [&]() -> Result<std::unique_ptr<Transport>> { return std::move(sink); }, "pulsepal:S", "S", 1, bench.clock));
    const auto before = allocationsOfThisThread();
    opened->forceOff();
    EXPECT_EQ(allocationsOfThisThread(), before);
    EXPECT_EQ(seen.urgent, 4);
}

TEST_F(PulsePal, AWriteThatBrokeOffIsNotFollowedByATrigger) {
    RecordProperty("hazard", "H2");
    bench.line->breakOff(3);
    EXPECT_THAT(bench.deliver(pulseTrain(2)), refused(ErrorCode::Timeout));
    EXPECT_EQ(commands(kTrigger), 0u);
    EXPECT_FALSE(bench.deliver(pulseTrain(2)));  // the device counts as lost until its status is read
    ASSERT_TRUE(bench.stimulator->status());
    EXPECT_TRUE(bench.deliver(pulseTrain(2)));
    bench.wait(Seconds(0.01));
    ASSERT_EQ(bench.line->phases().size(), 2u);
    EXPECT_NEAR(bench.line->phases()[0].volts.value(), 2, 4e-4);
}

TEST_F(PulsePal, AFrozenDeviceIsToldWithWhatHelps) {
    RecordProperty("hazard", "H2");
    bench.line->inspect([](auto& device, Instant now) { device.receive(Bytes{0xD5, 0x4A, 0x02}, now); });
    bench.wait(Seconds(0.6));
    EXPECT_FALSE(bench.deliver(pulseTrain(2)));
    EXPECT_THAT(bench.stimulator->status(), refusedSaying("joystick"));
    EXPECT_EQ(commands(kTrigger), 0u);
    bench.line->inspect([](auto& device, Instant now) { device.clickJoystick(now); });
    ASSERT_TRUE(bench.stimulator->status());
    EXPECT_TRUE(bench.deliver(pulseTrain(2)));
}

TEST(PulsePalFirmware, WithoutTheRestOfACommandItFreezesWithItsOutputsAsTheyAre) {
    RecordProperty("hazard", "H2");
    pulsepal::EmulatedPulsePal device;
    device.setReady(true);
    const auto program = accepted(pulsepal::programTrain(pulseTrain(5, 100), *pulsepal::Channel::of(1)));
    for (const auto& command : program.commands) device.receive(command.view(), Instant(0));
    device.receive(pulsepal::trigger(1).view(), std::chrono::milliseconds(10));
    // This command comes in the middle of a leading phase:
    device.receive(Bytes{0xD5, 0x4A, 0x02}, std::chrono::microseconds(20'100));
    EXPECT_FALSE(device.frozen(std::chrono::milliseconds(500)));
    EXPECT_TRUE(device.frozen(std::chrono::milliseconds(600)));
    EXPECT_NEAR(device.level(1, std::chrono::milliseconds(5000)).value(), 5, 4e-4);
    device.receive(pulsepal::abortTwice().view(), std::chrono::milliseconds(6000));
    EXPECT_TRUE(device.active(std::chrono::milliseconds(6001)));
    device.clickJoystick(std::chrono::milliseconds(7000));
    EXPECT_FALSE(device.active(std::chrono::milliseconds(7001)));
    EXPECT_EQ(device.level(1, std::chrono::milliseconds(7001)), Volts(0));
}

TEST(PulsePalFirmware, WithoutDtrNothingIsHeardAndTheOpenerIsToldSo) {
    VirtualClock clock;
    const auto deaf = std::make_shared<PulsePalLine>(clock, &clock, false);
    EXPECT_THAT(PulsePalStimulator::open(deaf->connector(), "pulsepal:S", "S", 1, clock), refused(ErrorCode::Timeout));
    EXPECT_LE(clock.now(), Instant(std::chrono::milliseconds(800)));
}

TEST(PulsePalOpen, AnotherModelAndAnotherChannelAreRefused) {
    RecordProperty("hazard", "H4");
    VirtualClock clock;
    const auto older = std::make_shared<PulsePalLine>(clock, &clock, true, 9);
    EXPECT_THAT(PulsePalStimulator::open(older->connector(), "pulsepal:S", "S", 1, clock),
                refused(ErrorCode::Unsupported));
    for (const int wrong : {0, 5}) {
        EXPECT_FALSE(PulsePalStimulator::open(older->connector(), "pulsepal:S", "S", wrong, clock));
    }
}

TEST_F(PulsePal, AnAckThatIsNoneKeepsTheTriggerBack) {
    RecordProperty("hazard", "H4");
    bench.line->garble(0x00);
    EXPECT_THAT(bench.deliver(pulseTrain(2)),
                refused(ErrorCode::Device, AllOf(HasSubstr("00"), HasSubstr("01 was expected"))));
    EXPECT_EQ(commands(kTrigger), 0u);
    EXPECT_FALSE(bench.stimulator->status());
    bench.line->garble(std::nullopt);
    EXPECT_TRUE(bench.stimulator->status());
    EXPECT_TRUE(bench.deliver(pulseTrain(2)));
}

TEST_F(PulsePal, UnpluggedInMidTrainIsFoundByItsStatusAndThePluggedInOneServesAgain) {
    RecordProperty("hazard", "H2");
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 5)));
    bench.wait(Seconds(0.01));
    bench.line->unplug();
    bench.wait(Seconds(0.05));
    EXPECT_THAT(bench.stimulator->status(), refused(ErrorCode::Device));
    EXPECT_FALSE(bench.deliver(pulseTrain(2)));
    EXPECT_FALSE(bench.stimulator->keepAlive());
    bench.line->plug();
    EXPECT_FALSE(bench.deliver(pulseTrain(2)));  // refused until the fault is reset
    ASSERT_TRUE(bench.stimulator->status());
    EXPECT_TRUE(bench.deliver(pulseTrain(2)));
    bench.wait(Seconds(0.01));
    EXPECT_EQ(bench.status().trainsDelivered, 2u);
}

TEST_F(PulsePal, TheWireIsLeftAloneWhileATrainRuns) {
    ASSERT_TRUE(bench.deliver(pulseTrain(2, 20)));
    const auto before = bench.line->written().size();
    for (int i = 0; i < 10; ++i) {
        bench.wait(Seconds(0.01));
        EXPECT_TRUE(bench.status().delivering);
        EXPECT_TRUE(bench.stimulator->keepAlive());
    }
    EXPECT_EQ(bench.line->written().size(), before);
}

TEST_F(PulsePal, ATrainOffTheGridIsRefusedByTheGateAndByTheDriver) {
    RecordProperty("hazard", "H1");
    const auto gate = benchGate(bench.clock, bench.stimulator->traits());
    TrainRequest request;
    request.train = pulseTrain(2);
    request.train.phaseWidth = Micros(225);
    request.onset = bench.clock.now();
    EXPECT_FALSE(gate->approve(request));
    request.train = pulseTrain(10.1);
    EXPECT_FALSE(gate->approve(request));
    // A gate for a finer device approves the train, but the driver still refuses it.
    SourceTraits finer = bench.stimulator->traits();
    finer.widthStep = Micros(1);
    const auto loose = benchGate(bench.clock, finer);
    request.train = pulseTrain(2);
    request.train.phaseWidth = Micros(225);
    auto approval = accepted(loose->approve(request));
    EXPECT_THAT(bench.stimulator->deliver(std::move(approval)), refused(ErrorCode::Device, "225"));
    EXPECT_EQ(commands(kTrigger), 0u);
}

TEST_F(PulsePal, IsRefusedForAPerson) {
    RecordProperty("hazard", "H1");
    LimitRow row;
    row.quantity = Quantity::PeakVoltage;
    row.max = 500;
    row.source = "test";
    GateSetup setup;
    setup.mode = OutputMode::Person;
    setup.source = bench.stimulator->traits();
    setup.limits.push_back({});
    setup.limits.back().id = setup.limits.back().title = "test";
    setup.limits.back().rows.push_back(row);
    setup.electrodeArea = SquareCentimetres(1);
    setup.calibration = StimulatorCalibration{{1, 0, 1, 10},
                                              CalibrationLine{1, 0, 0.1, 10},
                                              CalibrationLine{1, 0, 50e-6, 1e-3},
                                              CalibrationLine{1, 0, 50e-6, 1e-3}};
    setup.calibrated = true;
    setup.person = PersonSetup{};
    setup.person->participant = "P01";
    setup.person->consentRecorded = true;
    setup.person->discomfortLimit = Milliamps(10);
    setup.person->rampStep = Milliamps(1);
    SafetyGate gate(bench.clock);
    EXPECT_THAT(gate.configure(setup), refusedSaying("voltage source is refused for a person"));
    // The same setup with a current source is accepted: only the source was refused.
    setup.source.drive = Drive::Current;
    EXPECT_TRUE(gate.configure(setup));
}

}  // namespace
}  // namespace tacto::test
