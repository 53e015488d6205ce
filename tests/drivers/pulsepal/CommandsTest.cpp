// Pulse Pal's commands, byte by byte, and each parameter at its own place in the emulated device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include "core/base/Statistics.h"
#include "drivers/pulsepal/TrainProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/pulsepal/EmulatedPulsePal.h"

namespace tacto::test {
namespace {

using namespace pulsepal;
using testing::AllOf;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(const CommandBytes& command) { return {command.view().begin(), command.view().end()}; }
Channel channel(int number) { return Channel::of(number).value(); }
VoltageCode volts(double v) { return VoltageCode::of(Volts(v)).value(); }

// Checks the commands in resources/design/wire/pulsepal2.md.
TEST(PulsePalCommands, GoldenBytes) {
    EXPECT_EQ(bytesOf(handshake()), (Bytes{0xD5, 0x48}));
    EXPECT_EQ(bytesOf(trigger(0b0101)), (Bytes{0xD5, 0x4D, 0x05}));
    EXPECT_EQ(bytesOf(pulsepal::abort()), (Bytes{0xD5, 0x50}));
    EXPECT_EQ(bytesOf(abortTwice()), (Bytes{0xD5, 0x50, 0xD5, 0x50}));
    EXPECT_EQ(bytesOf(disconnect()), (Bytes{0xD5, 0x51}));
    EXPECT_EQ(bytesOf(clientName("TACTO")), (Bytes{0xD5, 0x59, 'T', 'A', 'C', 'T', 'O', ' '}));
    EXPECT_EQ(bytesOf(clientName("longer than six")), (Bytes{0xD5, 0x59, 'l', 'o', 'n', 'g', 'e', 'r'}));
    EXPECT_EQ(bytesOf(set(Switch::Biphasic, channel(2), true)), (Bytes{0xD5, 0x4A, 1, 2, 1}));
    EXPECT_EQ(bytesOf(set(Voltage::Phase1, channel(1), volts(10))), (Bytes{0xD5, 0x4A, 2, 1, 0xFF, 0xFF}));
    EXPECT_EQ(bytesOf(set(Voltage::Phase2, channel(4), volts(-5))), (Bytes{0xD5, 0x4A, 3, 4, 0x00, 0x40}));
    EXPECT_EQ(bytesOf(set(Voltage::Resting, channel(3), VoltageCode::zero())), (Bytes{0xD5, 0x4A, 17, 3, 0x00, 0x80}));
    EXPECT_EQ(bytesOf(set(Duration::InterPulse, channel(1), Cycles::exactly(0x01020304))),
              (Bytes{0xD5, 0x4A, 7, 1, 4, 3, 2, 1}));
    EXPECT_EQ(bytesOf(noCustomTrain(channel(1))), (Bytes{0xD5, 0x4A, 14, 1, 0}));
}

TEST(PulsePalCommands, EachParameterLandsInItsOwnSlotAndInNoOther) {
    RecordProperty("hazard", "H4");
    struct Slot {
        Parameter parameter;
        std::function<CommandBytes(Channel)> command;
        std::uint32_t value;
    };
    const auto duration = [](Parameter parameter, Duration what, std::uint32_t value) {
        return Slot{parameter, [=](Channel to) { return set(what, to, Cycles::exactly(value)); }, value};
    };
    const std::vector<Slot> slots{
        {Parameter::Biphasic, [](Channel to) { return set(Switch::Biphasic, to, true); }, 1},
        {Parameter::Phase1Voltage, [](Channel to) { return set(Voltage::Phase1, to, volts(3)); }, volts(3).code()},
        {Parameter::Phase2Voltage, [](Channel to) { return set(Voltage::Phase2, to, volts(-4)); }, volts(-4).code()},
        {Parameter::RestingVoltage, [](Channel to) { return set(Voltage::Resting, to, volts(1)); }, volts(1).code()},
        duration(Parameter::Phase1Duration, Duration::Phase1, 1001),
        duration(Parameter::InterPhaseInterval, Duration::InterPhase, 1002),
        duration(Parameter::Phase2Duration, Duration::Phase2, 1003),
        duration(Parameter::InterPulseInterval, Duration::InterPulse, 1004),
        duration(Parameter::BurstDuration, Duration::Burst, 1005),
        duration(Parameter::InterBurstInterval, Duration::InterBurst, 1006),
        duration(Parameter::TrainDuration, Duration::Train, 70'001'007),
        duration(Parameter::TrainDelay, Duration::TrainDelay, 1008),
        {Parameter::LinkTrigger1, [](Channel to) { return set(Switch::LinkTrigger1, to, true); }, 1},
        {Parameter::LinkTrigger2, [](Channel to) { return set(Switch::LinkTrigger2, to, true); }, 1},
        {Parameter::CustomTarget, [](Channel to) { return set(Switch::CustomTarget, to, true); }, 1},
        {Parameter::CustomLoop, [](Channel to) { return set(Switch::CustomLoop, to, true); }, 1},
    };
    for (int to = 1; to <= kChannels; ++to) {
        for (const auto& slot : slots) {
            const EmulatedPulsePal fresh;
            EmulatedPulsePal device;
            device.receive(slot.command(channel(to)).view(), Instant(0));
            device.receive({}, std::chrono::milliseconds(1));
            for (int other = 1; other <= kChannels; ++other) {
                for (const auto& look : slots) {
                    const bool here = other == to && look.parameter == slot.parameter;
                    EXPECT_EQ(device.stored(look.parameter, other),
                              here ? slot.value : fresh.stored(look.parameter, other))
                        << "command for parameter " << static_cast<int>(slot.parameter) << " on " << to
                        << ", seen in parameter " << static_cast<int>(look.parameter) << " on " << other;
                }
            }
        }
    }
}

TEST(PulsePalCommands, NoCommandIsContinuousMode) {
    RecordProperty("hazard", "H2");
    std::set<std::uint8_t> codes;
    for (const auto& command : {handshake(), trigger(15), pulsepal::abort(), disconnect(), clientName("x"),
                                set(Switch::CustomLoop, channel(1), true), noCustomTrain(channel(1))}) {
        codes.insert(command.bytes[1]);
    }
    EXPECT_FALSE(codes.contains(0x52));
}

TEST(PulsePalCommands, VoltagesRoundTowardZeroWithinOneStepOfTheMakersFormula) {
    RecordProperty("hazard", "H1");
    EXPECT_EQ(volts(0).code(), 32768);
    EXPECT_EQ(volts(-0.0).code(), 32768);
    EXPECT_EQ(volts(10).code(), 65535);
    EXPECT_EQ(volts(-10).code(), 0);
    EXPECT_EQ(volts(5).code(), 49151);
    EXPECT_EQ(volts(-5).code(), 16384);
    for (int i = -100'000; i <= 100'000; ++i) {
        const double v = i * 1e-4;
        const int code = volts(v).code();
        const int makers = static_cast<int>(std::ceil((v + 10) / 20 * 65535 - 1e-9));
        ASSERT_LE(std::abs(code - makers), v > 0 ? 1 : 0) << v;
        ASSERT_LE(std::abs(voltsOf(static_cast<std::uint16_t>(code)).value()), std::abs(v) + 1e-9) << v;
        ASSERT_NEAR(voltsOf(static_cast<std::uint16_t>(code)).value(), v, 1.5 * 20 / 65535)
            << v;  // 32768 stands for 0 V, half a step off
        if (std::abs(v) > 20.0 / 65535) {
            ASSERT_EQ(code + volts(-v).code(), 65535) << v;
        }
    }
}

TEST(PulsePalCommands, WhatIsOutOfRangeIsRefusedNotClamped) {
    RecordProperty("hazard", "H1");
    for (const double v : {10.0001, -10.0001, 1e9, kNaN, std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(VoltageCode::of(Volts(v)), refusedSaying("-10 to 10")) << v;
    }
    for (const double us : {-50.0, 3.7e9, kNaN}) {
        EXPECT_THAT(Cycles::of(Micros(us), "gap"), refusedSaying(AllOf(HasSubstr("gap"), HasSubstr("3600")))) << us;
    }
    EXPECT_THAT(Cycles::of(Micros(75), "phase width"), refusedSaying(AllOf(HasSubstr("75"), HasSubstr("50 us"))));
    EXPECT_EQ(Cycles::of(Micros(200), "x").value().count(), 4u);
    EXPECT_EQ(Cycles::of(Seconds(0.1 + 0.2), "x").value().count(), 6000u);  // decimal fractions are inexact in binary
    for (const int number : {0, 5, -1}) EXPECT_FALSE(Channel::of(number));
    EXPECT_EQ(channel(3).mask(), 0b100);
}

TEST(PulsePalCommands, AHandshakeIsReadOrRefusedByName) {
    RecordProperty("hazard", "H4");
    EXPECT_EQ(readHandshake(Bytes{0x4B, 21, 0, 0, 0}).value().firmware, 21u);
    EXPECT_EQ(readHandshake(Bytes{0x4B, 20, 0, 0, 0}).value().firmware, 20u);
    EXPECT_THAT(readHandshake(Bytes{0x4B, 9, 0, 0, 0}),
                refused(ErrorCode::Unsupported, AllOf(HasSubstr("firmware 9"), HasSubstr("20 or 21"))));
    EXPECT_EQ(readHandshake(Bytes{0x4B, 21, 1, 0, 0}).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(readHandshake(Bytes{0x4C, 21, 0, 0, 0}).error().code, ErrorCode::ParseError);
    EXPECT_EQ(readHandshake(Bytes{0x4B, 21}).error().code, ErrorCode::ParseError);
    EXPECT_EQ(readHandshake({}).error().code, ErrorCode::ParseError);
}

PulseTrain train(double v, int pulses, double rate) {
    PulseTrain made;
    made.amplitude = Volts(v);
    made.pulses = pulses;
    made.rate = Hertz(rate);
    return made;
}

/// Returns the phases that the emulated device plays for a train.
std::vector<EmittedPhase> played(const PulseTrain& wanted, int on = 1) {
    const auto program = programTrain(wanted, channel(on));
    EXPECT_TRUE(program) << program.error().message;
    EmulatedPulsePal device;
    device.setReady(true);
    for (const auto& command : program->commands) device.receive(command.view(), Instant(0));
    device.receive({}, std::chrono::milliseconds(10));
    device.receive(trigger(channel(on).mask()).view(), std::chrono::milliseconds(10));
    EXPECT_FALSE(device.active(std::chrono::milliseconds(11) + toInstant(Seconds(program->duration.time()))));
    return device.phases(std::chrono::seconds(100));
}

TEST(PulsePalTrain, IsPlayedAsItWasAsked) {
    RecordProperty("hazard", "H4");
    auto wanted = train(7, 3, 100);
    wanted.phaseWidth = Micros(250);
    wanted.interPhaseGap = Micros(150);
    const auto phases = played(wanted, 2);
    ASSERT_EQ(phases.size(), 6u);
    const Instant first = phases[0].begin;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& lead = phases[2 * i];
        const auto& second = phases[2 * i + 1];
        EXPECT_EQ(lead.channel, 2);
        EXPECT_EQ(lead.begin - first, std::chrono::milliseconds(10 * i));
        EXPECT_EQ(lead.end - lead.begin, std::chrono::microseconds(250));
        EXPECT_EQ(second.begin - lead.end, std::chrono::microseconds(150));
        EXPECT_EQ(second.end - second.begin, std::chrono::microseconds(250));
        EXPECT_NEAR(lead.volts.value(), 7, 4e-4);
        EXPECT_DOUBLE_EQ(second.volts.value(), -lead.volts.value());
    }
}

TEST(PulsePalTrain, OtherShapesAndPolarities) {
    auto negative = train(2, 1, 100);
    negative.polarity = Polarity::Negative;
    negative.interPhaseGap = Micros(0);
    auto phases = played(negative);
    ASSERT_EQ(phases.size(), 2u);
    EXPECT_NEAR(phases[0].volts.value(), -2, 4e-4);
    EXPECT_NEAR(phases[1].volts.value(), 2, 4e-4);
    EXPECT_EQ(phases[0].end, phases[1].begin);

    auto mono = train(3, 2, 50);
    mono.shape = PulseShape::Monophasic;
    phases = played(mono);
    ASSERT_EQ(phases.size(), 2u);
    EXPECT_EQ(phases[1].begin - phases[0].begin, std::chrono::milliseconds(20));

    auto slow = train(10, 1, 100);
    slow.shape = PulseShape::AsymmetricBiphasic;
    slow.rechargeRatio = 10;
    phases = played(slow);
    ASSERT_EQ(phases.size(), 2u);
    EXPECT_NEAR(phases[1].volts.value(), -1, 4e-4);
    EXPECT_EQ(phases[1].end - phases[1].begin, std::chrono::milliseconds(2));
}

TEST(PulsePalTrain, WhatTheDeviceCannotDoIsRefusedByName) {
    RecordProperty("hazard", "H1");
    const auto refusal = [](const PulseTrain& wanted) {
        const auto program = programTrain(wanted, channel(1));
        EXPECT_FALSE(program);
        return program ? std::string() : program.error().message;
    };
    EXPECT_THAT(refusal(train(10.5, 1, 100)), AllOf(HasSubstr("10.5 V"), HasSubstr("-10 to 10")));
    auto current = train(0, 1, 100);
    current.amplitude = Milliamps(5);
    EXPECT_THAT(refusal(current), AllOf(HasSubstr("mA"), HasSubstr("voltage source")));
    auto offGrid = train(1, 1, 100);
    offGrid.phaseWidth = Micros(225);
    EXPECT_THAT(refusal(offGrid), AllOf(HasSubstr("phase width"), HasSubstr("225"), HasSubstr("50 us")));
    offGrid = train(1, 1, 100);
    offGrid.interPhaseGap = Micros(10);
    EXPECT_THAT(refusal(offGrid), HasSubstr("inter-phase gap"));
    EXPECT_THAT(refusal(train(1, 2, 60)), HasSubstr("period"));
    EXPECT_TRUE(programTrain(train(1, 1, 60), channel(1)));  // a single pulse needs no rate
    offGrid = train(1, 1, 100);
    offGrid.phaseWidth = Micros(50);
    EXPECT_THAT(refusal(offGrid), HasSubstr("100 us or more"));
    EXPECT_THAT(refusal(train(1, 2, 2000)), HasSubstr("cycles between pulses"));
    EXPECT_TRUE(programTrain(train(1, 200, 100), channel(1)));
    EXPECT_THAT(refusal(train(1, 202, 100)), AllOf(HasSubstr("dead-man"), HasSubstr("at most 2 s")));
    EXPECT_FALSE(programTrain(train(std::numeric_limits<double>::quiet_NaN(), 1, 100), channel(1)));
}

}  // namespace
}  // namespace tacto::test
