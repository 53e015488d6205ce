// Butterworth.h - the causal band-pass in front of roughness: order 2 per edge, two biquads.
//
// The same filter as `butter(2, [low, high], bandpass)` elsewhere: bilinear transform with pre-warped edges.
//
// Thread-safety: none; one owner. Never allocates.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace tacto {

/// y = b·x - a·y, a0 = 1.
struct Biquad {
    std::array<double, 3> b;
    std::array<double, 2> a;  ///< a1, a2
};

/// The first section holds both zeros at 0 Hz, the second both zeros at half the rate and all of the gain.
/// 0 < low < high < rate / 2, all finite.
[[nodiscard]] std::array<Biquad, 2> butterworthBandpass(double low_hz, double high_hz, double rate_hz) noexcept;

/// Filters up to 3 axes side by side: their recursions do not wait for each other.
class AxesBandpass {
public:
    static constexpr std::size_t kMaxAxes = 3;

    /// `axes` 1..3.
    AxesBandpass(double low_hz, double high_hz, double rate_hz, std::size_t axes) noexcept;

    /// Starts over at the steady state of `sample` (one value per axis), so that an offset makes no transient.
    void restart(const double* sample) noexcept;

    /// `interleaved` holds `count` samples of all axes; axis i goes to out[i][0..count).
    void process(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept;

private:
    // GCC and clang keep a pair in one register; four lanes are axes x y | z unused.
    using Pair __attribute__((vector_size(16))) = double;
    template <std::size_t Axes>
    void run(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept;

    std::array<Biquad, 2> sections_;  // Constant after construction
    std::size_t axes_;                // Constant after construction
    Pair state_[2][4] = {};           // per pair of axes: high-pass z1, z2, low-pass z1, z2
};

}  // namespace tacto
