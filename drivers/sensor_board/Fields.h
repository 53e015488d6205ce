// Fields.h - reads little-endian fields from a payload without trusting its length.
//
// Thread-safety: none; one owner.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tacto::sensorboard {

/// Reads fields in order. After the end, every field reads as 0 and whole() is false.
class FieldReader {
public:
    explicit FieldReader(std::span<const std::uint8_t> bytes) noexcept : bytes_(bytes) {}

    [[nodiscard]] std::uint8_t u8() noexcept { return static_cast<std::uint8_t>(little(1)); }
    [[nodiscard]] std::uint16_t u16() noexcept { return static_cast<std::uint16_t>(little(2)); }
    [[nodiscard]] std::uint32_t u32() noexcept { return static_cast<std::uint32_t>(little(4)); }
    [[nodiscard]] std::uint64_t u64() noexcept { return little(8); }
    [[nodiscard]] double f32() noexcept { return static_cast<double>(std::bit_cast<float>(u32())); }
    /// Reads a text of `size` bytes, up to its first zero; bytes that are not printable ASCII become "?".
    [[nodiscard]] std::string text(std::size_t size) {
        std::string found;
        bool ended = false;
        for (std::size_t i = 0; i < size; ++i) {
            const auto byte = u8();
            ended = ended || byte == 0;
            if (!ended) found += byte >= 0x20 && byte <= 0x7E ? static_cast<char>(byte) : '?';
        }
        return found;
    }
    [[nodiscard]] std::span<const std::uint8_t> rest() const noexcept { return bytes_; }
    /// True if every field was present and nothing is left over.
    [[nodiscard]] bool whole() const noexcept { return !short_ && bytes_.empty(); }

private:
    [[nodiscard]] std::uint64_t little(std::size_t size) noexcept {
        if (bytes_.size() < size) {
            short_ = true;
            bytes_ = {};
            return 0;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(bytes_[i]) << (8 * i);
        bytes_ = bytes_.subspan(size);
        return value;
    }

    std::span<const std::uint8_t> bytes_;
    bool short_ = false;
};

inline void putU32(std::vector<std::uint8_t>& into, std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) into.push_back(static_cast<std::uint8_t>(value >> shift));
}
inline void putF32(std::vector<std::uint8_t>& into, float value) { putU32(into, std::bit_cast<std::uint32_t>(value)); }

}  // namespace tacto::sensorboard
