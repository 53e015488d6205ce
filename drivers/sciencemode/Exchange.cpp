#include "drivers/sciencemode/Exchange.h"

#include <algorithm>
#include <cstdlib>

#include "drivers/sciencemode/Acks.h"

namespace tacto::sciencemode {
namespace {

constexpr std::uint8_t kLowStopNumber = 62;
constexpr std::uint8_t kMidStopNumber = 63;

StopFrames makeStopFrames() {
    StopFrames frames;
    const auto low =
        encodeFrame({static_cast<std::uint16_t>(Command::LowLevelStop), kLowStopNumber, {}}, frames.lowLevel);
    const auto mid =
        encodeFrame({static_cast<std::uint16_t>(Command::MidLevelStop), kMidStopNumber, {}}, frames.midLevel);
    frames.bothSize = frames.lowLevel.size + frames.midLevel.size;
    if (!low || !mid || frames.bothSize > frames.both.size()) {
        std::abort();  // a device that could not be stopped must not be opened
    }
    const auto end = std::ranges::copy(frames.lowLevel.view(), frames.both.begin()).out;
    std::ranges::copy(frames.midLevel.view(), end);
    return frames;
}

}  // namespace

const StopFrames& stopFrames() noexcept {
    static const StopFrames frames = makeStopFrames();
    return frames;
}

Result<void> Exchange::send(Command command, std::span<const std::uint8_t> payload) {
    number_ = static_cast<std::uint8_t>(number_ + 1 < kLowStopNumber ? number_ + 1 : 0);
    command_ = command;
    if (auto encoded = encodeFrame({static_cast<std::uint16_t>(command), number_, payload}, frame_); !encoded) {
        return encoded;
    }
    auto written = transport_.write(frame_.view(), kAnswerTime);
    if (!written && written.error().code == ErrorCode::Device) gone_ = true;
    return written;
}

Result<std::size_t> Exchange::refill(Seconds left) {
    const auto got = transport_.read(chunk_, left);
    if (!got) {
        if (got.error().code == ErrorCode::Device) gone_ = true;
        return got;
    }
    unread_ = std::span<const std::uint8_t>(chunk_).first(std::min(*got, chunk_.size()));
    return got;
}

tl::unexpected<Error> Exchange::silence(std::uint64_t junkBefore) const {
    if (const auto junk = decoder_.junkBytes() - junkBefore; junk > 0) {
        return fail(ErrorCode::Device,
                    "the stimulator answered {} with garbage: {} bytes without a frame of a fitting length and CRC",
                    nameOf(command_), junk);
    }
    return fail(ErrorCode::Timeout, "the stimulator did not answer {} in time", nameOf(command_));
}

Result<std::span<const std::uint8_t>> Exchange::receive(Seconds allowed) {
    const Instant deadline = clock_.now() + toInstant(allowed);
    const auto junkBefore = decoder_.junkBytes();
    std::size_t taken = 0;
    for (;;) {
        while (const auto packet = decoder_.take(unread_)) {
            const bool numbered = packet->number == number_;
            if (numbered && packet->command == ackOf(command_)) return packet->payload;
            const bool general = packet->command == static_cast<std::uint16_t>(Command::GeneralError);
            const bool unknown = packet->command == static_cast<std::uint16_t>(Command::UnknownCommand);
            if (numbered && (general || unknown)) {
                if (packet->payload.size() == 1) {
                    return refusal(command_, static_cast<ResultCode>(packet->payload.front()));
                }
                return refusal(command_, unknown ? ResultCode::InvalidCommand : ResultCode::Protocol);
            }
            ++stray_;
        }
        const Instant now = clock_.now();
        // Stops listening to a device that never pauses, whatever the clock says.
        if (now >= deadline || taken > kMaxGarbage) return silence(junkBefore);
        const auto got = refill(Seconds(deadline - now));
        if (got) {
            taken += *got;
        } else if (got.error().code == ErrorCode::Timeout) {
            return silence(junkBefore);
        } else {
            return failure(got);
        }
    }
}

Result<std::span<const std::uint8_t>> Exchange::ask(Command command, std::span<const std::uint8_t> payload,
                                                    Seconds allowed) {
    if (auto sent = send(command, payload); !sent) return failure(sent);
    return receive(allowed);
}

ExchangeCounts Exchange::counts() const noexcept { return {decoder_.junkBytes(), decoder_.brokenFrames(), stray_}; }

}  // namespace tacto::sciencemode
