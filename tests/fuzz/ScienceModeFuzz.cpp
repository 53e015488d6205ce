// Any bytes from a stimulator, or to an emulated stimulator, are read as frames or skipped; they never cause a crash, a
// hang or growing memory, or the loss of a valid frame after them (hazard H10). The first byte chooses.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "drivers/sciencemode/Exchange.h"
#include "drivers/sciencemode/ReadBack.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::fuzz::ScienceModeFuzz {

namespace {

using namespace tacto;
using namespace tacto::sciencemode;

PulsePlan samplePlan() {
    PulseTrain train;
    train.amplitude = Milliamps(5);
    return *planPulse(train);
}

void parse(std::span<const std::uint8_t> payload) {
    static const PulsePlan plan = samplePlan();
    ChannelConfigAck ack;
    if (readChannelConfigAck(payload, ack)) {
        const auto reading = readPulse(ack, plan, Volts(150));
        require(!reading.impedance || reading.impedance->value() >= 0);
        require(!reading.imbalance || (*reading.imbalance >= 0 && *reading.imbalance <= 1));
        if (ack.complete) {
            const auto again = payloadOf(ack);
            require(again.size <= payload.size() && std::ranges::equal(again.view(), payload.first(again.size)));
        }
    }
    if (const auto id = readDeviceIdAck(payload)) require(id->id.size() <= 10);
    static_cast<void>(readStimStatusAck(payload));
    static_cast<void>(readExtendedVersionAck(payload));
    static_cast<void>(readPlainAck(sciencemode::Command::LowLevelStop, payload));
    // Building from the values that were read gives the same bytes.
    if (const auto request = readChannelConfig(payload)) {
        const auto again = payloadOf(*request);
        require(again && readChannelConfig(again->view()).has_value());
    }
    static_cast<void>(readLowLevelInit(payload));
}

/// A device that answers with the input.
class InputTransport final : public Transport {
public:
    explicit InputTransport(std::span<const std::uint8_t> input) : input_(input) {}
    Result<void> write(std::span<const std::uint8_t>, Seconds) override { return {}; }
    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds) override {
        if (input_.empty()) return fail(ErrorCode::Timeout, "no more");
        const auto part = input_.first(std::min(input_.size(), into.size()));
        std::ranges::copy(part, into.begin());
        input_ = input_.subspan(part.size());
        return part.size();
    }
    std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t>) noexcept override {}

private:
    std::span<const std::uint8_t> input_;
};

/// Decodes any bytes, followed by a valid frame.
void decode(std::span<const std::uint8_t> input) {
    FrameDecoder decoder;
    auto rest = input;
    while (const auto packet = decoder.take(rest)) {
        FrameBytes frame;
        require(encodeFrame(*packet, frame).has_value());
        parse(packet->payload);
    }
    FrameBytes good;
    require(encodeFrame({35, 60, {}}, good).has_value());
    std::vector<std::uint8_t> twice(good.view().begin(), good.view().end());
    twice.insert(twice.end(), good.view().begin(), good.view().end());
    std::span<const std::uint8_t> view(twice);
    int found = 0;
    while (const auto packet = decoder.take(view)) found += packet->command == 35 && packet->number == 60 ? 1 : 0;
    require(found >= 1);

    VirtualClock clock;
    InputTransport transport(input);
    Exchange exchange(transport, clock);
    for (int i = 0; i < 4; ++i) static_cast<void>(exchange.ask(sciencemode::Command::StimStatus));
}

/// Sends requests in valid frames: each has a length, a command and a payload, with time in between.
void request(std::span<const std::uint8_t> input) {
    EmulatedStimulator device;
    Instant now{0};
    std::array<std::uint8_t, 2048> answers{};
    while (input.size() >= 3) {
        const auto length = std::min<std::size_t>({input[0], input.size() - 3, kMaxPayload});
        FrameBytes frame;
        const auto command = static_cast<std::uint16_t>(input[1] % 70);
        require(
            encodeFrame({command, static_cast<std::uint8_t>(input[2] & kMaxNumber), input.subspan(3, length)}, frame)
                .has_value());
        device.receive(frame.view(), now);
        now += std::chrono::milliseconds(input[2]);
        std::span<const std::uint8_t> got(answers.data(), device.transmit(answers, now));
        FrameDecoder decoder;
        while (const auto packet = decoder.take(got)) parse(packet->payload);
        input = input.subspan(3 + length);
    }
    device.receive(stopFrames().lowLevel.view(), now);
    device.receive(stopFrames().midLevel.view(), now);
    const auto before = device.pulses(now).size();
    require(device.pulses(now + std::chrono::seconds(10)).size() == before);  // once off, it stays off
}

}  // namespace

TACTO_FUZZ(ScienceModeFuzz, const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> input(data + 1, size - 1);
    switch (data[0] % 3) {
        case 0:
            decode(input);
            break;
        case 1:
            parse(input);
            break;
        default:
            request(input);
            break;
    }
    return 0;
}

}  // namespace tacto::fuzz::ScienceModeFuzz
