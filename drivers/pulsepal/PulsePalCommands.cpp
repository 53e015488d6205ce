#include "drivers/pulsepal/PulsePalCommands.h"

#include <algorithm>
#include <cmath>

namespace tacto::pulsepal {

namespace {

constexpr std::uint8_t kHandshakeCode = 0x48;
constexpr std::uint8_t kParameterCode = 0x4A;
constexpr std::uint8_t kTriggerCode = 0x4D;
constexpr std::uint8_t kAbortCode = 0x50;
constexpr std::uint8_t kDisconnectCode = 0x51;
constexpr std::uint8_t kNameCode = 0x59;
constexpr std::uint8_t kHandshakeReply = 0x4B;
constexpr double kStepsOfRange = 65535;

CommandBytes made(std::initializer_list<std::uint8_t> bytes) noexcept {
    CommandBytes command;
    std::ranges::copy(bytes, command.bytes.begin());
    command.size = bytes.size();
    return command;
}

CommandBytes parameter(Parameter which, std::uint8_t channel, std::uint32_t value) noexcept {
    auto command = made({kStart, kParameterCode, static_cast<std::uint8_t>(which), channel});
    for (std::size_t i = 0; i < sizeOf(which); ++i) {
        command.bytes[command.size++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    return command;
}

}  // namespace

Result<Channel> Channel::of(int number) {
    if (number < 1 || number > kChannels) {
        return fail(ErrorCode::InvalidArgument, "output channel {}; 1 to {} are accepted", number, kChannels);
    }
    return Channel(static_cast<std::uint8_t>(number));
}

Result<Cycles> Cycles::of(Micros time, const char* what) {
    const double cycles = time / kCycle;
    if (!(cycles >= 0 && cycles <= kMaxCycles)) {
        return fail(ErrorCode::InvalidArgument, "{} {:.6g} us; 0 to 3600 s are accepted", what, time.count());
    }
    const double whole = std::round(cycles);
    if (!(std::abs(cycles - whole) <= 1e-6)) {
        return fail(ErrorCode::InvalidArgument, "{} {:.9g} us is not a multiple of the device's {:.0f} us", what,
                    time.count(), kCycle.count());
    }
    return Cycles(static_cast<std::uint32_t>(whole));
}

Result<VoltageCode> VoltageCode::of(Volts volts) {
    const double v = volts.value();
    if (!(v >= -kMaxVolts && v <= kMaxVolts)) {
        return fail(ErrorCode::InvalidArgument, "{:.6g} V; {} to {} V are accepted", v, -kMaxVolts, kMaxVolts);
    }
    const double exact = (v + kMaxVolts) / (2 * kMaxVolts) * kStepsOfRange;
    const double nearest = std::round(exact);
    // A value within a millionth of a step of a code is taken as that code.
    const double toward = std::abs(exact - nearest) <= 1e-6 ? nearest : v > 0 ? std::floor(exact) : std::ceil(exact);
    // A positive voltage below half a step has no code of its own: the zero code is nearer than the code below 0 V.
    return VoltageCode(static_cast<std::uint16_t>(v > 0 ? std::max(toward, double{kZeroVolts}) : toward));
}

Volts voltsOf(std::uint16_t code) noexcept {
    if (code == kZeroVolts) return Volts(0);
    return Volts(code * (2 * kMaxVolts) / kStepsOfRange - kMaxVolts);
}

Volts VoltageCode::volts() const noexcept { return voltsOf(code_); }

std::size_t sizeOf(Parameter parameter) noexcept {
    if (parameter >= Parameter::Phase1Duration && parameter <= Parameter::TrainDelay) return 4;
    if (parameter == Parameter::Phase1Voltage || parameter == Parameter::Phase2Voltage ||
        parameter == Parameter::RestingVoltage) {
        return 2;
    }
    const bool known =
        (parameter >= Parameter::Biphasic && parameter <= Parameter::CustomLoop) || parameter == Parameter::TriggerMode;
    return known ? 1 : 0;
}

CommandBytes set(Switch what, Channel channel, bool on) noexcept {
    return parameter(static_cast<Parameter>(what), channel.number(), on ? 1 : 0);
}

CommandBytes set(Voltage what, Channel channel, VoltageCode value) noexcept {
    return parameter(static_cast<Parameter>(what), channel.number(), value.code());
}

CommandBytes set(Duration what, Channel channel, Cycles value) noexcept {
    return parameter(static_cast<Parameter>(what), channel.number(), value.count());
}

CommandBytes noCustomTrain(Channel channel) noexcept { return parameter(Parameter::CustomTrain, channel.number(), 0); }

CommandBytes handshake() noexcept { return made({kStart, kHandshakeCode}); }
CommandBytes trigger(std::uint8_t mask) noexcept { return made({kStart, kTriggerCode, mask}); }
CommandBytes abort() noexcept { return made({kStart, kAbortCode}); }
CommandBytes abortTwice() noexcept { return made({kStart, kAbortCode, kStart, kAbortCode}); }
CommandBytes disconnect() noexcept { return made({kStart, kDisconnectCode}); }

CommandBytes clientName(std::string_view name) noexcept {
    auto command = made({kStart, kNameCode, ' ', ' ', ' ', ' ', ' ', ' '});
    for (std::size_t i = 0; i < std::min<std::size_t>(name.size(), 6); ++i) {
        const char c = name[i];
        command.bytes[2 + i] = static_cast<std::uint8_t>(c >= ' ' && c <= '~' ? c : '?');
    }
    return command;
}

Result<Handshake> readHandshake(std::span<const std::uint8_t> reply) {
    if (reply.size() != kHandshakeSize) {
        return fail(ErrorCode::ParseError, "Pulse Pal: a handshake of {} bytes; {} were expected", reply.size(),
                    kHandshakeSize);
    }
    if (reply[0] != kHandshakeReply) {
        return fail(ErrorCode::ParseError, "Pulse Pal: the handshake begins with {:02X}; 4B was expected", reply[0]);
    }
    Handshake found;
    for (std::size_t i = 0; i < 4; ++i) found.firmware |= std::uint32_t{reply[1 + i]} << (8 * i);
    if (found.firmware != 20 && found.firmware != 21) {
        return fail(ErrorCode::Unsupported, "Pulse Pal: firmware {}; 20 or 21 is accepted, Pulse Pal 2's",
                    found.firmware);
    }
    return found;
}

}  // namespace tacto::pulsepal
