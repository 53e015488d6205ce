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

    /// Uniform in [0, 1).
    [[nodiscard]] double uniform() noexcept;
    /// Standard normal.
    [[nodiscard]] double normal() noexcept;
    /// Uniform in 0..bound-1; bound ≥ 1.
    [[nodiscard]] std::uint64_t below(std::uint64_t bound) noexcept;

private:
    std::mt19937_64 engine_;
    std::optional<double> spare_;  ///< the second of a pair of normal draws
};

}  // namespace tacto
