#include "drivers/sciencemode/Frame.h"

#include <algorithm>

namespace tacto::sciencemode {
namespace {

constexpr std::uint8_t kStart = 0xF0;
constexpr std::uint8_t kEnd = 0x0F;
constexpr std::uint8_t kEscape = 0x81;
constexpr std::uint8_t kMask = 0x55;
constexpr std::size_t kHeader = 9;  // bytes of start, length and CRC

constexpr bool isStuffed(std::uint8_t byte) noexcept { return byte == kStart || byte == kEnd || byte == kEscape; }
constexpr std::uint8_t masked(unsigned byte) noexcept { return static_cast<std::uint8_t>((byte & 0xFFU) ^ kMask); }

/// Returns the number in the two escaped bytes at `at` and `at` + 2.
std::size_t wordAt(const std::uint8_t* at) noexcept {
    return (static_cast<std::size_t>(masked(at[0])) << 8U) | masked(at[2]);
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) noexcept {
    std::uint16_t crc = 0;
    for (const auto byte : bytes) {
        crc = static_cast<std::uint16_t>(crc ^ (static_cast<unsigned>(byte) << 8U));
        for (int bit = 0; bit < 8; ++bit) {
            const unsigned shifted = static_cast<unsigned>(crc) << 1U;
            crc = static_cast<std::uint16_t>((crc & 0x8000U) != 0 ? shifted ^ 0x1021U : shifted);
        }
    }
    return crc;
}

Result<void> encodeFrame(const Packet& packet, FrameBytes& into) {
    if (packet.command > kMaxCommand) {
        return fail(ErrorCode::InvalidArgument, "ScienceMode command {} does not fit 10 bits: at most {}",
                    packet.command, kMaxCommand);
    }
    if (packet.number > kMaxNumber) {
        return fail(ErrorCode::InvalidArgument, "ScienceMode packet number {} does not fit 6 bits: at most {}",
                    packet.number, kMaxNumber);
    }
    if (packet.payload.size() > kMaxPayload) {
        return fail(ErrorCode::InvalidArgument, "a ScienceMode payload of {} bytes is too long: at most {}",
                    packet.payload.size(), kMaxPayload);
    }
    std::size_t at = kHeader;
    const auto put = [&](std::uint8_t byte) {
        if (isStuffed(byte)) {
            into.bytes[at++] = kEscape;
            byte = masked(byte);
        }
        into.bytes[at++] = byte;
    };
    const unsigned head = (static_cast<unsigned>(packet.number) << 10U) | packet.command;
    put(static_cast<std::uint8_t>(head >> 8U));
    put(static_cast<std::uint8_t>(head & 0xFFU));
    for (const auto byte : packet.payload) put(byte);

    const unsigned crc = crc16({into.bytes.data() + kHeader, at - kHeader});
    into.bytes[at++] = kEnd;
    into.size = at;
    const auto length = static_cast<unsigned>(at);
    into.bytes[0] = kStart;
    std::size_t header = 1;
    for (const unsigned byte : {length >> 8U, length, crc >> 8U, crc}) {
        into.bytes[header++] = kEscape;
        into.bytes[header++] = masked(byte);
    }
    return {};
}

FrameDecoder::Finding FrameDecoder::examine() noexcept {
    for (; examined_ < size_; ++examined_) {
        const auto byte = buffer_[examined_];
        if (examined_ == 0) {
            if (byte != kStart) return Finding::Broken;
        } else if (examined_ < kHeader) {
            if (examined_ % 2 == 1 && byte != kEscape) return Finding::Broken;
            if (examined_ == 4) {
                length_ = wordAt(&buffer_[2]);
                if (length_ < kMinFrame || length_ > kMaxFrame) return Finding::Broken;
            }
        } else if (examined_ + 1 == length_) {
            const std::span<const std::uint8_t> stuffed(buffer_.data() + kHeader, length_ - kFrameOverhead);
            const bool whole = byte == kEnd && crc16(stuffed) == wordAt(&buffer_[6]) && unstuff();
            return whole ? Finding::Complete : Finding::Broken;
        } else if (byte == kStart || byte == kEnd) {
            return Finding::Broken;  // the length is wrong: do not wait for so many bytes
        }
    }
    return Finding::Incomplete;
}

bool FrameDecoder::unstuff() noexcept {
    bodySize_ = 0;
    const std::size_t end = length_ - 1;
    for (std::size_t at = kHeader; at < end; ++at) {
        auto byte = buffer_[at];
        if (byte == kEscape) {
            if (++at == end) return false;
            byte = masked(buffer_[at]);
            if (!isStuffed(byte)) return false;
        }
        if (bodySize_ == body_.size()) return false;
        body_[bodySize_++] = byte;
    }
    return bodySize_ >= 2;
}

void FrameDecoder::drop(std::size_t bytes) noexcept {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(bytes),
              buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
    size_ -= bytes;
    examined_ = 0;
    length_ = 0;
}

void FrameDecoder::resynchronise() noexcept {
    if (buffer_[0] == kStart) ++broken_;
    std::size_t next = 1;
    while (next < size_ && buffer_[next] != kStart) ++next;
    junk_ += next;
    drop(next);
}

std::optional<Packet> FrameDecoder::take(std::span<const std::uint8_t>& input) noexcept {
    for (;;) {
        switch (examine()) {
            case Finding::Complete: {
                drop(length_);
                const unsigned head = (static_cast<unsigned>(body_[0]) << 8U) | body_[1];
                return Packet{static_cast<std::uint16_t>(head & kMaxCommand), static_cast<std::uint8_t>(head >> 10U),
                              std::span<const std::uint8_t>(body_.data() + 2, bodySize_ - 2)};
            }
            case Finding::Broken:
                resynchronise();
                break;
            case Finding::Incomplete:
                if (input.empty()) return std::nullopt;
                buffer_[size_++] = input.front();
                input = input.subspan(1);
                break;
        }
    }
}

}  // namespace tacto::sciencemode
