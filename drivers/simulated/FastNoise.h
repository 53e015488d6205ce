// FastNoise.h - fast seeded noise for loops that make tens of thousands of samples per millisecond.
//
// Uses xoshiro256+; a normal value is the sum of four 16-bit uniform values (variance 1, excess kurtosis -0.3, at most
// 3.46): good enough for sensor noise, at a tenth of the cost of std::normal_distribution.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/Random.h"

namespace tacto::sim {

class FastNoise {
public:
    FastNoise(std::uint64_t seed, std::string_view stream) {
        Random random(seed, stream);
        for (auto& word : state_) word = random.below(~std::uint64_t{0}) | 1U;
    }

    [[nodiscard]] std::uint64_t bits() noexcept {
        const std::uint64_t result = state_[0] + state_[3];
        const std::uint64_t shifted = state_[1] << 17U;
        state_[2] ^= state_[0];
        state_[3] ^= state_[1];
        state_[1] ^= state_[2];
        state_[0] ^= state_[3];
        state_[2] ^= shifted;
        state_[3] = (state_[3] << 45U) | (state_[3] >> 19U);
        return result;
    }

    /// Returns a uniform value in [0, 1).
    [[nodiscard]] double uniform() noexcept { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

    /// Returns a value with mean 0 and standard deviation 1.
    [[nodiscard]] double normal() noexcept {
        // Adds all four 16-bit fields of a word at once: first to two 17-bit sums, then to one 18-bit sum.
        const std::uint64_t word = bits();
        const std::uint64_t pairs = (word & 0x0000FFFF0000FFFFU) + ((word >> 16U) & 0x0000FFFF0000FFFFU);
        const auto sum = static_cast<std::int64_t>((pairs & 0xFFFFFFFFU) + (pairs >> 32U));
        return static_cast<double>(sum - std::int64_t{2} * 65535) * kScale;
    }

private:
    // One 16-bit uniform value has the standard deviation sqrt((65536² - 1) / 12); the sum of four has twice that.
    static constexpr double kScale = 1.0 / 37837.2271;
    std::uint64_t state_[4];
};

}  // namespace tacto::sim
