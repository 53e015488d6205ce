#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

#include <algorithm>
#include <cmath>

namespace tacto::sciencemode {
namespace {

Payload resultAlone(ResultCode result) noexcept {
    Payload payload;
    payload.push(static_cast<unsigned>(result));
    return payload;
}

/// Returns the result code that the load causes for a pulse.
ResultCode resultOf(const EmittedPulse& pulse, bool open) noexcept {
    if (open) return ResultCode::Electrode;
    const double commanded = std::abs(pulse.points.items[0].current.value()) * 1e-3;
    const double reached = std::abs(pulse.totals.leadingEndCurrent_A);
    return reached < 0.9 * commanded ? ResultCode::LowCurrent : ResultCode::Ok;
}

}  // namespace

EmulatedStimulator::EmulatedStimulator(EmulatedSettings settings)
    : settings_(std::move(settings)), output_(settings_.load, settings_.compliance) {}

void EmulatedStimulator::receive(std::span<const std::uint8_t> bytes, Instant now) {
    advance(now);
    if (garbage_ > 0) {
        std::vector<std::uint8_t> noise(garbage_);
        // The noise sometimes looks like frames, which is harder to handle than plain noise.
        for (std::size_t i = 0; i < noise.size(); ++i) {
            noise[i] = static_cast<std::uint8_t>(i % 37 == 0 ? 0xF0 : i % 2 == 1 ? 0x81 : 0x55 + i % 5);
        }
        queue(std::move(noise), now);
        return;
    }
    while (const auto packet = decoder_.take(bytes)) handle(*packet, now);
}

std::size_t EmulatedStimulator::transmit(std::span<std::uint8_t> into, Instant now) {
    std::size_t written = 0;
    while (!outgoing_.empty() && outgoing_.front().due <= now && written < into.size()) {
        auto& bytes = outgoing_.front().bytes;
        const auto part = std::min(bytes.size(), into.size() - written);
        std::copy_n(bytes.begin(), part, into.begin() + static_cast<std::ptrdiff_t>(written));
        written += part;
        bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(part));
        if (bytes.empty()) outgoing_.pop_front();
    }
    return written;
}

std::optional<Instant> EmulatedStimulator::nextTransmit() const noexcept {
    if (outgoing_.empty()) return std::nullopt;
    return outgoing_.front().due;
}

void EmulatedStimulator::misbehave(AckFault fault, int times) {
    for (int i = 0; i < times; ++i) faults_.push_back(fault);
}

void EmulatedStimulator::fit(const Load& load, Instant now) {
    advance(now);
    output_.fit(load, now);
}

void EmulatedStimulator::powerCycle(Instant now) {
    advance(now);
    output_.cut(now);
    repetition_.reset();
    lowLevel_ = false;
    decoder_ = FrameDecoder();
    outgoing_.clear();
}

const std::deque<EmittedPulse>& EmulatedStimulator::pulses(Instant now) {
    advance(now);
    return output_.pulses();
}

bool EmulatedStimulator::repeating(Instant now) {
    advance(now);
    return repetition_.has_value();
}

Stimulation EmulatedStimulator::state(Instant now) {
    if (repeating(now)) return Stimulation::MidLevelRunning;
    return lowLevel_ ? Stimulation::LowLevel : Stimulation::None;
}

std::uint64_t EmulatedStimulator::requests(Command command) const noexcept {
    return requests_[static_cast<std::size_t>(command)];
}

void EmulatedStimulator::startRepeating(const Points& points, Seconds period, Instant now) {
    lowLevel_ = false;
    repetition_ = Repetition{points, toInstant(period), now};
}

void EmulatedStimulator::advance(Instant now) {
    for (; repetition_ && repetition_->next <= now; repetition_->next += repetition_->period) {
        output_.play(repetition_->points, 0, true, repetition_->next, nullptr, false);
    }
}

void EmulatedStimulator::handle(const Packet& packet, Instant now) {
    const Instant due = now + toInstant(settings_.latency);
    if (packet.command < requests_.size()) ++requests_[packet.command];
    switch (static_cast<Command>(packet.command)) {
        case Command::LowLevelInit: {
            const auto request = readLowLevelInit(packet.payload);
            if (!request) return acknowledge(packet, ResultCode::Parameter, due);
            repetition_.reset();
            init_ = *request;
            lowLevel_ = true;
            return acknowledge(packet, ResultCode::Ok, due);
        }
        case Command::ChannelConfig:
            return configureChannel(packet, now);
        case Command::LowLevelStop:
            output_.cut(now);
            lowLevel_ = false;
            return acknowledge(packet, ResultCode::Ok, due);
        case Command::MidLevelStop:
            if (repetition_) output_.cut(now);
            repetition_.reset();
            return acknowledge(packet, ResultCode::Ok, due);
        case Command::DeviceId:
            return acknowledge(packet, payloadOf(DeviceIdAck{settings_.id}), due);
        case Command::Reset:
            output_.cut(now);
            repetition_.reset();
            lowLevel_ = false;
            return acknowledge(packet, ResultCode::Ok, due);
        case Command::StimStatus: {
            const auto level =
                static_cast<std::uint8_t>(lowLevel_ || repetition_ ? HighVoltage::V150 : HighVoltage::Off);
            return acknowledge(packet, payloadOf(StimStatusAck{state(now), level}), due);
        }
        case Command::ExtendedVersion:
            return acknowledge(packet, payloadOf(ExtendedVersionAck{settings_.firmware, settings_.protocol}), due);
        case Command::GeneralError:
        case Command::UnknownCommand:
            break;
    }
    FrameBytes frame;
    const Payload payload = resultAlone(ResultCode::InvalidCommand);
    const Packet answer{static_cast<std::uint16_t>(Command::UnknownCommand), packet.number, payload.view()};
    if (encodeFrame(answer, frame)) queue({frame.view().begin(), frame.view().end()}, due);
}

void EmulatedStimulator::configureChannel(const Packet& packet, Instant now) {
    const Instant soon = now + toInstant(settings_.latency);
    const auto request = readChannelConfig(packet.payload);
    if (!request) return acknowledge(packet, ResultCode::Parameter, soon);
    if (!lowLevel_) return acknowledge(packet, ResultCode::NotInitialised, soon);
    if (output_.active(now)) return acknowledge(packet, ResultCode::Busy, soon);
    ChannelConfigAck ack;
    ack.complete = true;
    ack.channel = request->channel;
    ack.connector = request->connector;
    ack.measurement = init_.measurement;
    if (!request->execute) return acknowledge(packet, payloadOf(ack), soon);
    const bool open = output_.isOpen(now);
    const int channel = 4 * request->connector + request->channel;
    const auto& pulse = output_.play(request->points, channel, false, now, &ack, settings_.sampleTimeIsTotal);
    ack.result = resultOf(pulse, open);
    acknowledge(packet, payloadOf(ack), pulse.end + toInstant(settings_.latency));
}

void EmulatedStimulator::acknowledge(const Packet& to, ResultCode result, Instant due) {
    acknowledge(to, resultAlone(result), due);
}

void EmulatedStimulator::acknowledge(const Packet& to, const Payload& payload, Instant due) {
    std::optional<AckFault> fault;
    if (!faults_.empty()) {
        fault = faults_.front();
        faults_.pop_front();
    }
    if (fault == AckFault::Drop) return;
    Payload sent = payload;
    Packet packet{ackOf(static_cast<Command>(to.command)), to.number, {}};
    if (fault == AckFault::WrongNumber) packet.number = static_cast<std::uint8_t>((packet.number + 7) & kMaxNumber);
    if (fault == AckFault::WrongCommand) packet.command = ackOf(Command::Reset);
    if (fault == AckFault::Truncated) --sent.size;
    if (fault == AckFault::WrongChannel && sent.size > 1) sent.bytes[1] ^= 0x01;
    if (fault == AckFault::Refused) sent = resultAlone(ResultCode::StimulatorTimeout);
    packet.payload = sent.view();
    FrameBytes frame;
    if (!encodeFrame(packet, frame)) return;
    std::vector<std::uint8_t> bytes(frame.view().begin(), frame.view().end());
    if (fault == AckFault::WrongLength) bytes[4] ^= 0x02;
    if (fault == AckFault::WrongCrc) bytes[8] ^= 0x10;
    if (fault == AckFault::Junk) bytes.insert(bytes.begin(), {0x00, 0xF0, 0x81, 0x55, 0xF0, 0x81, 0x55, 0x81});
    if (fault == AckFault::Duplicate) queue(bytes, due);
    queue(std::move(bytes), fault == AckFault::Delay ? due + toInstant(kLate) : due);
}

void EmulatedStimulator::queue(std::vector<std::uint8_t> bytes, Instant due) {
    const auto later = [&](const Outgoing& other) { return other.due > due; };
    outgoing_.insert(std::ranges::find_if(outgoing_, later), Outgoing{due, std::move(bytes)});
}

}  // namespace tacto::sciencemode
