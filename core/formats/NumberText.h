// NumberText.h - one decimal number out of the middle of a line, fast: what the time of reading a table goes into.
//
// Up to eight digits are taken at a time, as the bytes of one integer, without a branch for each. What that way cannot
// do exactly (more than 2^53 in digits, powers beyond 10^22, "nan") is left to another: a number that is returned here
// is the double nearest to the text, as std::from_chars gives.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace tacto {

/// Bytes that must be readable behind any number given to takeNumber(), and before and behind any field of
/// FieldNumber.h.
constexpr std::size_t kNumberPadding = 64;

namespace number_text {

static_assert(std::endian::native == std::endian::little, "the digits of an eight-byte load are read from its low end");

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> kTens{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                       1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::array<std::uint64_t, 9> kWholeTens{1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

inline std::uint64_t load(const char* text) noexcept {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text, sizeof bytes);
    return bytes;
}

/// Where digits have become 0 to 9: the highest bit of the first byte that is no digit; of bytes behind it, some.
inline std::uint64_t noDigits(std::uint64_t nibbles) noexcept {
    return ((nibbles + 0x7676767676767676ULL) | nibbles) & 0x8080808080808080ULL;
}

/// Eight digits as a number, the first of them in the lowest byte: pairs, fours and eights are added up side by side.
inline std::uint64_t eightDigits(std::uint64_t digits) noexcept {
    digits = (digits * 10 + (digits >> 8)) & 0x00FF00FF00FF00FFULL;
    digits = (digits * 100 + (digits >> 16)) & 0x0000FFFF0000FFFFULL;
    return (digits * 10000 + (digits >> 32)) & 0xFFFFFFFFULL;
}

/// The value of the digits that `text` begins with, eight at most, and how many they are.
inline std::uint64_t takeDigits(const char* text, unsigned& count) noexcept {
    const std::uint64_t nibbles = load(text) ^ 0x3030303030303030ULL;
    count = static_cast<unsigned>(std::countr_zero(noDigits(nibbles))) / 8;
    // Zeros in front of the digits.
    return count == 0 ? 0 : eightDigits(nibbles << (64 - 8 * count));
}

}  // namespace number_text

/// Reads the number that begins at `text` and gives the place behind it; null where none does that can be read exactly.
/// `point` is '.' or ','. Reads up to kNumberPadding bytes behind the number.
inline const char* takeNumber(const char* text, char point, double& value) noexcept {
    using namespace number_text;
    // Samples of an alternating signal change their sign at random: nothing here may hang on a guess.
    const bool negative = *text == '-';
    text += static_cast<int>(negative) | static_cast<int>(*text == '+');
    unsigned count = 0;
    std::uint64_t mantissa = takeDigits(text, count);
    text += count;
    unsigned digits = count;
    int exponent = 0;
    while (count == 8) {
        const std::uint64_t more = takeDigits(text, count);
        mantissa = mantissa * kWholeTens[count] + more;
        text += count;
        digits += count;
        if (digits > 18) return nullptr;
    }
    if (*text == point) {
        ++text;
        const char* const fraction = text;
        do {
            const std::uint64_t more = takeDigits(text, count);
            // Eight more digits overflow only what is refused below: leading zeros do not count.
            if (mantissa > 99'999'999'999ULL) {
                if (count != 0) return nullptr;
                break;
            }
            mantissa = mantissa * kWholeTens[count] + more;
            text += count;
        } while (count == 8);
        const auto places = static_cast<unsigned>(text - fraction);
        if (places > 40) return nullptr;
        digits += places;
        exponent = -static_cast<int>(places);
    }
    if (digits == 0) return nullptr;
    if ((*text | 0x20) == 'e') {
        ++text;
        const bool down = *text == '-';
        if (down || *text == '+') ++text;
        const auto power = static_cast<int>(takeDigits(text, count));
        if (count == 0 || count == 8) return nullptr;
        text += count;
        exponent += down ? -power : power;
    }
    if (mantissa > (1ULL << 53U)) return nullptr;
    // Both operands are exact, so the one rounding of the product or quotient is the nearest double (Clinger 1990).
    double magnitude = static_cast<double>(static_cast<std::int64_t>(mantissa));
    if (exponent < 0) {
        if (exponent < -22) return nullptr;
        magnitude /= kTens[static_cast<std::size_t>(-exponent)];
    } else if (exponent > 0) {
        if (exponent > 22) return nullptr;
        magnitude *= kTens[static_cast<std::size_t>(exponent)];
    }
    value = negative ? -magnitude : magnitude;
    return text;
}

constexpr std::uint64_t eightTimes(char c) noexcept { return 0x0101010101010101ULL * static_cast<unsigned char>(c); }

}  // namespace tacto
