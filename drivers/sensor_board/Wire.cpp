#include "drivers/sensor_board/Wire.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <zlib.h>

#include "drivers/sensor_board/Fields.h"

namespace tacto::sensorboard {

namespace {
constexpr std::size_t kCrcBytes = 4;
constexpr std::uint8_t kFullGroup = 0xFF;  // a group of 254 bytes without a zero
}  // namespace

std::uint32_t crcOf(std::span<const std::uint8_t> bytes) noexcept {
    return static_cast<std::uint32_t>(::crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

std::optional<Frame> FrameDecoder::take(std::span<const std::uint8_t>& bytes) noexcept {
    while (!bytes.empty()) {
        const auto* zero = static_cast<const std::uint8_t*>(std::memchr(bytes.data(), 0, bytes.size()));
        const std::size_t part = zero != nullptr ? static_cast<std::size_t>(zero - bytes.data()) : bytes.size();
        if (part > stuffed_.size() - held_) skipping_ = true;
        if (skipping_) {
            held_ = 0;
        } else if (part > 0) {
            std::memcpy(stuffed_.data() + held_, bytes.data(), part);
            held_ += part;
        }
        counts_.bytes += part + (zero != nullptr ? 1 : 0);
        bytes = bytes.subspan(part + (zero != nullptr ? 1 : 0));
        if (zero == nullptr) break;
        if (const auto frame = finish()) return frame;
    }
    return std::nullopt;
}

std::optional<Frame> FrameDecoder::finish() noexcept {
    if (skipping_) {
        skipping_ = false;
        ++counts_.tooLong;
        return std::nullopt;
    }
    if (held_ == 0) return std::nullopt;
    const auto size = unstuff();
    held_ = 0;
    if (!size || *size < kMinContent || *size > kMaxContent) {
        ++counts_.malformed;
        return std::nullopt;
    }
    const auto content = std::span(content_).first(*size);
    const auto covered = content.first(*size - kCrcBytes);
    if (FieldReader(content.subspan(covered.size())).u32() != crcOf(covered)) {
        ++counts_.badCrc;
        return std::nullopt;
    }
    ++counts_.frames;
    return Frame{content[0], content[1], covered.subspan(2)};
}

std::optional<std::size_t> FrameDecoder::unstuff() noexcept {
    // Stuffed bytes contain no zero, as take() stops there. The content is never longer than the stuffed bytes.
    std::size_t from = 0, to = 0;
    while (from < held_) {
        const std::size_t code = stuffed_[from];
        if (code > held_ - from) return std::nullopt;
        std::memcpy(content_.data() + to, stuffed_.data() + from + 1, code - 1);
        to += code - 1;
        from += code;
        if (from < held_ && code != kFullGroup) content_[to++] = 0;
    }
    return to;
}

std::vector<std::uint8_t> encodeCommand(Command command, std::uint8_t token, std::span<const std::uint8_t> payload) {
    assert(payload.size() < kMaxPayload);
    std::vector<std::uint8_t> content{versionOf(command), static_cast<std::uint8_t>(command), token};
    content.insert(content.end(), payload.begin(), payload.end());
    putU32(content, crcOf(content));

    std::vector<std::uint8_t> sent{0};
    std::size_t code = sent.size();  // index where the group's length is written
    sent.push_back(1);
    for (const auto byte : content) {
        if (byte != 0) {
            sent.push_back(byte);
            ++sent[code];
        } else {
            code = sent.size();
            sent.push_back(1);
        }
    }
    sent.push_back(0);
    return sent;
}

}  // namespace tacto::sensorboard
