#include "core/dsp/Butterworth.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace tacto {

std::array<Biquad, 2> butterworthBandpass(double low_hz, double high_hz, double rate_hz) noexcept {
    using Complex = std::complex<double>;
    const double twice = 2 * rate_hz;
    const double low = twice * std::tan(std::numbers::pi * low_hz / rate_hz);
    const double high = twice * std::tan(std::numbers::pi * high_hz / rate_hz);
    const double bandwidth = high - low;

    // Each pole p of the order-2 low-pass becomes the two roots of s² - p·bandwidth·s + low·high. The conjugate pole
    // gives the conjugate roots, so each root forms a biquad with its conjugate.
    const Complex prototype = std::polar(1.0, 0.75 * std::numbers::pi);
    const Complex half = prototype * bandwidth * 0.5;
    const Complex root = std::sqrt(half * half - low * high);
    const std::array<Complex, 2> poles = std::abs(half - root) < std::abs(half + root)
                                             ? std::array{half - root, half + root}
                                             : std::array{half + root, half - root};

    double gain = bandwidth * bandwidth * twice * twice;
    std::array<Biquad, 2> sections{};
    for (std::size_t i = 0; i < 2; ++i) {
        const Complex digital = (twice + poles[i]) / (twice - poles[i]);
        sections[i].a = {-2 * digital.real(), std::norm(digital)};
        gain /= std::norm(twice - poles[i]);
    }
    sections[0].b = {1, -2, 1};
    sections[1].b = {gain, 2 * gain, gain};
    return sections;
}

AxesBandpass::AxesBandpass(double low_hz, double high_hz, double rate_hz, std::size_t axes) noexcept
    : sections_(butterworthBandpass(low_hz, high_hz, rate_hz)), axes_(axes) {}

void AxesBandpass::restart(const double* sample) noexcept {
    // For a constant x the output of the high-pass section is 0, and its states are -x and x.
    const Pair none{0, 0};
    for (std::size_t pair = 0; pair < 2; ++pair) {
        const std::size_t axis = 2 * pair;
        const Pair x{axis < axes_ ? sample[axis] : 0, axis + 1 < axes_ ? sample[axis + 1] : 0};
        state_[pair][0] = -x;
        state_[pair][1] = x;
        state_[pair][2] = none;
        state_[pair][3] = none;
    }
}

template <std::size_t Axes>
void AxesBandpass::run(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept {
    constexpr std::size_t kPairs = (Axes + 1) / 2;
    const double a1 = sections_[0].a[0];
    const double a2 = sections_[0].a[1];
    const double gain = sections_[1].b[0];
    const double c1 = sections_[1].a[0];
    const double c2 = sections_[1].a[1];
    Pair z[kPairs][4];
    for (std::size_t p = 0; p < kPairs; ++p) {
        for (std::size_t s = 0; s < 4; ++s) z[p][s] = state_[p][s];
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t p = 0; p < kPairs; ++p) {
            constexpr bool kOdd = Axes % 2 == 1;
            const double* sample = interleaved + i * Axes + 2 * p;
            const bool lone = kOdd && p + 1 == kPairs;
            const Pair x{sample[0], lone ? 0.0 : sample[1]};
            const Pair high = x + z[p][0];
            z[p][0] = z[p][1] - (x + x) - a1 * high;
            z[p][1] = x - a2 * high;
            const Pair scaled = gain * high;
            const Pair low = scaled + z[p][2];
            z[p][2] = z[p][3] + (scaled + scaled) - c1 * low;
            z[p][3] = scaled - c2 * low;
            out[2 * p][i] = low[0];
            if (!lone) out[2 * p + 1][i] = low[1];
        }
    }
    for (std::size_t p = 0; p < kPairs; ++p) {
        for (std::size_t s = 0; s < 4; ++s) state_[p][s] = z[p][s];
    }
}

void AxesBandpass::process(const double* interleaved, std::size_t count, std::span<double* const> out) noexcept {
    switch (axes_) {
        case 1:
            return run<1>(interleaved, count, out);
        case 2:
            return run<2>(interleaved, count, out);
        default:
            return run<3>(interleaved, count, out);
    }
}

}  // namespace tacto
