#include "core/formats/FieldEnds.h"

#include <algorithm>
#include <bit>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tacto {

namespace {

/// A bit for each of 64 characters that is one of two.
std::uint64_t eitherOf64(const char* text, char one, char other) noexcept {
    std::uint64_t bits = 0;
#ifdef __SSE2__
    const __m128i first = _mm_set1_epi8(one);
    const __m128i second = _mm_set1_epi8(other);
    for (unsigned part = 0; part < 4; ++part) {
        const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(text + 16 * part));
        const __m128i found = _mm_or_si128(_mm_cmpeq_epi8(bytes, first), _mm_cmpeq_epi8(bytes, second));
        bits |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(found))) << (16 * part);
    }
#else
    for (unsigned i = 0; i < 64; ++i) {
        bits |= static_cast<std::uint64_t>(text[i] == one || text[i] == other) << i;
    }
#endif
    return bits;
}

/// std::popcount() is a call on processors of 2003, which are what the compiler is told to serve.
std::size_t ones(std::uint64_t bits) noexcept {
    bits -= (bits >> 1) & 0x5555555555555555ULL;
    bits = (bits & 0x3333333333333333ULL) + ((bits >> 2) & 0x3333333333333333ULL);
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0FULL;
    return bits * 0x0101010101010101ULL >> 56;
}

}  // namespace

void FieldEnds::look(const char* begin, const char* end) noexcept {
    const auto length = std::min(static_cast<std::size_t>(end - begin), kLooked);
    std::size_t count = 0;
    for (std::size_t at = 0; at < length; at += kAtOnce) {
        std::uint64_t bits = eitherOf64(begin + at, separator_, '\n');
        if (length - at < kAtOnce) bits &= (1ULL << (length - at)) - 1;
        const auto found = ones(bits);
        // Four at a time without asking whether there are as many: what is too much is written over next.
        for (std::size_t k = 0; k < found; k += 4) {
            for (std::size_t i = 0; i < 4; ++i) {
                ends_[count + k + i] =
                    static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(std::countr_zero(bits));
                bits &= bits - 1;
            }
        }
        count += found;
    }
    count_ = count;
}

}  // namespace tacto
