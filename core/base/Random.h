// Random.h - seeded randomness; the only source of it, so that the same seed gives the same bytes.
//
// Each user takes a stream of its own by name (`Random(seed, "oscilloscope noise")`), so that adding a
// draw in one place does not shift every other.
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
    std::optional<double> spare_;  ///< normal draws come in pairs
};

}  // namespace tacto
