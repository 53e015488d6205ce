// Random.h - random numbers from a seed. There is no other source, so that the same seed gives the same bytes.
//
// Each user has a stream of its own by name (`Random(seed, "oscilloscope noise")`), so that an additional draw in one
// place does not shift the draws in other places.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string_view>

namespace tacto {

class Random {
public:
    Random(std::uint64_t seed, std::string_view stream);

    /// Returns a uniform random number in [0, 1).
    [[nodiscard]] double uniform() noexcept;
    /// Returns a standard normal random number.
    [[nodiscard]] double normal() noexcept;
    /// Returns a uniform random whole number from 0 to bound-1; `bound` must be at least 1.
    [[nodiscard]] std::uint64_t below(std::uint64_t bound) noexcept;

private:
    std::mt19937_64 engine_;
    std::optional<double> spare_;  ///< the second of a pair of normal draws
};

}  // namespace tacto
