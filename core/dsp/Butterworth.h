// Butterworth.h - the causal band-pass applied before roughness is computed: order 2 per edge, two biquads.
//
// The same filter as `butter(2, [low, high], bandpass)` in other software: bilinear transform with pre-warped edges.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace tacto {

/// A second-order section: y = b·x - a·y, with a0 = 1.
struct Biquad {
    std::array<double, 3> b;
    std::array<double, 2> a;  ///< coefficients a1 and a2
};

/// Designs the band-pass. The first section has both zeros at 0 Hz; the second has both zeros at half the rate and all
/// of the gain. Requires 0 < low < high < rate / 2, all finite.
[[nodiscard]] std::array<Biquad, 2> butterworthBandpass(double low_hz, double high_hz, double rate_hz) noexcept;

/// Filters up to 3 axes in parallel, so that their recursions do not wait for each other.
class AxesBandpass {
public:
    static constexpr std::size_t kMaxAxes = 3;

    /// `axes`: 1 to 3.
    AxesBandpass(double low_hz, double high_hz, double rate_hz, std::size_t axes) noexcept;

    /// Restarts in the steady state of `sample` (one value per axis), so that an offset causes no transient.
    void restart(const double* sample) noexcept;

    /// Filters `count` samples of all axes from `interleaved`; axis i is written to out[i][0..count).
    void process(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept;

private:
    // GCC and clang keep a pair in one register. The four lanes hold x, y, z and one unused value.
    using Pair __attribute__((vector_size(16))) = double;
    template <std::size_t Axes>
    void run(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept;

    std::array<Biquad, 2> sections_;  // constant after construction
    std::size_t axes_;                // constant after construction
    Pair state_[2][4] = {};           // for each pair of axes: high-pass z1, z2, low-pass z1, z2
};

}  // namespace tacto
