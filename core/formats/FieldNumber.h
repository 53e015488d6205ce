// FieldNumber.h - a field of a table as a number, where it is known where the field ends: nothing waits for digits to
// be counted, and one field is converted beside the next.
//
// Both ways read a number of up to 16 characters behind its '-', without an exponent; any other field is left to
// takeNumber(). They give the double nearest to the text ("-0" is 0). The first needs SSE2, which every 64-bit x86 has.
//
// Thread-safety: pure functions. kNumberPadding bytes before and behind the field must be readable.
#pragma once

#include "core/formats/NumberText.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tacto {

namespace number_text {

/// mantissa / 10^places with its sign. Exact operands, one rounding; the sign is cheapest on the integer.
inline double decimal(std::uint64_t mantissa, unsigned places, bool negative) noexcept {
    const auto sign = -static_cast<std::int64_t>(negative);
    return static_cast<double>((static_cast<std::int64_t>(mantissa) ^ sign) - sign) / kTens[places];
}

/// Sixteen bytes of nothing and sixteen of everything: from byte n on, a mask of the last n of sixteen.
alignas(16) inline constexpr std::array<std::uint8_t, 32> kLast{
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
    0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

}  // namespace number_text

#ifdef __SSE2__
/// Sixteen bytes at a time. They are loaded up to the field's end, so that the last digit is always the last byte; a
/// second load, one byte earlier, has what stands before the point in its place.
[[gnu::always_inline]] inline bool wideFieldNumber(const char* begin, const char* end, char point,
                                                   double& value) noexcept {
    using namespace number_text;
    const auto load16 = [](const void* bytes) { return _mm_loadu_si128(static_cast<const __m128i*>(bytes)); };
    const bool negative = *begin == '-';
    begin += static_cast<int>(negative);
    const auto length = static_cast<unsigned>(end - begin);
    if (length - 1U > 15U) return false;
    const __m128i behind = load16(end - 16);
    const __m128i before = load16(end - 17);
    const auto points = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(behind, _mm_set1_epi8(point))));
    // A bit for each character of the field, and one behind them for a field without a point.
    const auto whole = static_cast<unsigned>(std::countr_zero((points >> (16 - length)) | (1U << length)));
    const bool pointed = whole < length;
    const unsigned digits = length - static_cast<unsigned>(pointed);
    const unsigned places = digits - whole;
    const __m128i moved = load16(kLast.data() + (pointed ? places : 16));
    __m128i number = _mm_or_si128(_mm_and_si128(moved, behind), _mm_andnot_si128(moved, before));
    number = _mm_and_si128(_mm_sub_epi8(number, _mm_set1_epi8('0')), load16(kLast.data() + digits));
    const __m128i wrong = _mm_subs_epu8(number, _mm_set1_epi8(9));
    if (_mm_movemask_epi8(_mm_cmpeq_epi8(wrong, _mm_setzero_si128())) != 0xFFFF || digits == 0) return false;
    // Two digits, then four, then eight of them become a number.
    const __m128i twos = _mm_add_epi16(_mm_mullo_epi16(_mm_and_si128(number, _mm_set1_epi16(0xFF)), _mm_set1_epi16(10)),
                                       _mm_srli_epi16(number, 8));
    const __m128i fours = _mm_madd_epi16(twos, _mm_set1_epi32(0x00010064));
    const __m128i eights = _mm_madd_epi16(_mm_packs_epi32(fours, fours), _mm_set1_epi32(0x00012710));
    const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights));
    const std::uint64_t mantissa = (both & 0xFFFFFFFFULL) * 100'000'000ULL + (both >> 32);
    if (mantissa > (1ULL << 53U)) return false;
    value = decimal(mantissa, places, negative);
    return true;
}
#endif

/// The same anywhere: eight bytes at a time, as one integer.
inline bool plainFieldNumber(const char* begin, const char* end, char point, double& value) noexcept {
    using namespace number_text;
    const bool negative = *begin == '-';
    begin += static_cast<int>(negative);
    const auto length = static_cast<unsigned>(end - begin);
    if (length - 1U > 15U) return false;
    std::array<char, 24> text{};  // the digits alone, the last of them at its sixteenth byte
    text.fill('0');
    unsigned digits = 0;
    unsigned places = 0;
    bool pointed = false;
    for (unsigned i = length; i > 0; --i) {
        const char c = begin[i - 1];
        if (c == point && !pointed) {
            pointed = true;
            places = digits;
        } else {
            text[15 - digits++] = c;
        }
    }
    const std::uint64_t first = load(text.data()) ^ 0x3030303030303030ULL;
    const std::uint64_t second = load(text.data() + 8) ^ 0x3030303030303030ULL;
    if (digits == 0 || (noDigits(first) | noDigits(second)) != 0) return false;
    const std::uint64_t mantissa = eightDigits(first) * 100'000'000ULL + eightDigits(second);
    if (mantissa > (1ULL << 53U)) return false;
    value = decimal(mantissa, places, negative);
    return true;
}

/// The faster of them.
[[gnu::always_inline]] inline bool fieldNumber(const char* begin, const char* end, char point, double& value) noexcept {
#ifdef __SSE2__
    return wideFieldNumber(begin, end, point, value);
#else
    return plainFieldNumber(begin, end, point, value);
#endif
}

}  // namespace tacto
