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

/// Bytes that must be readable behind any number given to takeNumber() or fieldNumber().
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

/// Which bytes are no digit, where digits have become 0 to 9: the highest bit of each.
inline std::uint64_t noDigits(std::uint64_t nibbles) noexcept {
    return (((nibbles & 0x7F7F7F7F7F7F7F7FULL) + 0x7676767676767676ULL) | nibbles) & 0x8080808080808080ULL;
}

/// Eight digits as a number, the first of them in the lowest byte: pairs, fours and eights are added up side by side.
inline std::uint64_t eightDigits(std::uint64_t digits) noexcept {
    digits = (digits * 10 + (digits >> 8)) & 0x00FF00FF00FF00FFULL;
    digits = (digits * 100 + (digits >> 16)) & 0x0000FFFF0000FFFFULL;
    return (digits * 10000 + (digits >> 32)) & 0xFFFFFFFFULL;
}

/// The highest bit of the first byte of `bytes` that equals `wanted` (eight times that character); bytes behind it may
/// be marked as well. 0 if none does.
inline std::uint64_t marked(std::uint64_t bytes, std::uint64_t wanted) noexcept {
    const std::uint64_t differing = bytes ^ wanted;
    return (differing - 0x0101010101010101ULL) & ~differing & 0x8080808080808080ULL;
}
/// How many bytes are in front of the first mark; 8 without one.
inline unsigned before(std::uint64_t marks) noexcept { return static_cast<unsigned>(std::countr_zero(marks)) / 8; }
/// All bits of those bytes.
inline std::uint64_t below(std::uint64_t marks) noexcept { return ((marks & (~marks + 1)) >> 7) - 1; }

inline double signedAs(double magnitude, bool negative) noexcept {
    constexpr unsigned kSignBit = 63;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) ^
                                 (static_cast<std::uint64_t>(negative) << kSignBit));
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
    value = signedAs(magnitude, negative);
    return text;
}

/// Reads a whole field that is a number of up to 16 characters without an exponent; false for any other. Where it ends
/// is known here, so that nothing waits for the digits to be counted and fields are converted side by side.
/// `points` is the decimal point, eight times: see eightTimes().
[[gnu::always_inline]] inline bool fieldNumber(const char* begin, const char* end, std::uint64_t points,
                                               double& value) noexcept {
    using namespace number_text;
    const bool negative = *begin == '-';
    begin += static_cast<int>(negative) | static_cast<int>(*begin == '+');
    const auto length = static_cast<unsigned>(end - begin);
    if (length - 1U > 15U) return false;
    const std::uint64_t low = load(begin);
    const std::uint64_t lowMarks = marked(low, points);
    const std::uint64_t lowKept = below(lowMarks);
    unsigned whole = before(lowMarks);
    std::uint64_t mantissa = 0;
    unsigned digits = length;
    if (length <= 8) {
        // The point, if it is in the field, goes; what is behind it moves up.
        digits -= static_cast<unsigned>(whole < length);
        if (digits == 0) return false;
        const std::uint64_t merged = (low & lowKept) | ((low >> 8) & ~lowKept);
        const std::uint64_t nibbles = (merged ^ 0x3030303030303030ULL) << (64 - 8 * digits);
        if (noDigits(nibbles) != 0) return false;
        mantissa = eightDigits(nibbles);
    } else {
        const std::uint64_t high = load(begin + 8);
        std::uint64_t first = low;
        std::uint64_t second = high >> 8;
        if (whole < 8) {
            first = (low & lowKept) | (((low >> 8) | (high << 56)) & ~lowKept);
        } else {
            const std::uint64_t highMarks = marked(high, points);
            const std::uint64_t highKept = below(highMarks);
            whole += before(highMarks);
            second = (high & highKept) | ((high >> 8) & ~highKept);
        }
        digits -= static_cast<unsigned>(whole < length);
        const std::uint64_t nibbles = first ^ 0x3030303030303030ULL;
        if (noDigits(nibbles) != 0) return false;
        mantissa = eightDigits(nibbles);
        if (digits > 8) {
            const std::uint64_t rest = (second ^ 0x3030303030303030ULL) << (128 - 8 * digits);
            if (noDigits(rest) != 0) return false;
            mantissa = mantissa * kWholeTens[digits - 8] + eightDigits(rest);
            if (mantissa > (1ULL << 53U)) return false;
        }
    }
    const unsigned places = whole < length ? digits - whole : 0;
    // Through a signed number: without AVX-512 the unsigned conversion is a branch and twice as long.
    const auto magnitude = static_cast<double>(static_cast<std::int64_t>(mantissa)) / kTens[places];
    value = signedAs(magnitude, negative);
    return true;
}

constexpr std::uint64_t eightTimes(char c) noexcept { return 0x0101010101010101ULL * static_cast<unsigned char>(c); }

}  // namespace tacto
