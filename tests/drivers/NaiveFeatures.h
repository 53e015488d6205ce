// NaiveFeatures.h - computes science.md's features as directly as possible, to check the twin independently of the
// product's own chain: direct Fourier sums over Hann windows, with means removed instead of a band-pass.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/base/Stream.h"

namespace tacto::test {

struct NaiveFrame {
    double t_s = 0;
    double power = 0;     ///< power from 5 Hz to 1 kHz
    double h = 0;         ///< share of `power` above 200 Hz
    double v = 0;         ///< taxel variance / mean²
    double centroid = 0;  ///< spectral centroid in Hz
};

/// Returns a frame of 64 ms of 4 kHz acceleration and 200 Hz taxels per `hop_s` after `from_s`. `baseline`: per taxel.
inline std::vector<NaiveFrame> naiveFrames(const SampleBlock& acceleration, const SampleBlock& taxels,
                                           std::span<const double> baseline, double from_s, double hop_s = 0.064) {
    constexpr std::size_t kWindow = 256;
    constexpr double kRate = 4000;
    std::array<std::array<double, kWindow>, 65> cosine{}, sine{};
    for (std::size_t k = 0; k <= 64; ++k) {
        for (std::size_t n = 0; n < kWindow; ++n) {
            const double turn = 2 * std::numbers::pi / kWindow;
            const double hann = 0.5 - 0.5 * std::cos(turn * static_cast<double>(n));
            const double phase = turn * static_cast<double>(k * n % kWindow);
            cosine[k][n] = hann * std::cos(phase);
            sine[k][n] = hann * std::sin(phase);
        }
    }
    std::vector<NaiveFrame> frames;
    const auto hop = static_cast<std::size_t>(hop_s * kRate);
    for (std::size_t begin = 0; begin + kWindow <= acceleration.samples(); begin += hop) {
        NaiveFrame frame;
        frame.t_s = acceleration.t_s[begin + kWindow / 2];
        if (frame.t_s < from_s) continue;
        double high = 0, moment = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<double, kWindow> x{};
            double mean = 0;
            for (std::size_t n = 0; n < kWindow; ++n) mean += acceleration.values[(begin + n) * 3 + axis] / kWindow;
            for (std::size_t n = 0; n < kWindow; ++n) x[n] = acceleration.values[(begin + n) * 3 + axis] - mean;
            for (std::size_t k = 1; k <= 64; ++k) {
                double re = 0, im = 0;
                for (std::size_t n = 0; n < kWindow; ++n) {
                    re += x[n] * cosine[k][n];
                    im += x[n] * sine[k][n];
                }
                const double power = re * re + im * im;
                const double frequency = static_cast<double>(k) * kRate / kWindow;
                frame.power += power;
                moment += power * frequency;
                if (frequency >= 200) high += power;
            }
        }
        frame.h = high / frame.power;
        frame.centroid = moment / frame.power;
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < taxels.samples(); ++i) {
            if (std::abs(taxels.t_s[i] - frame.t_s) < std::abs(taxels.t_s[nearest] - frame.t_s)) nearest = i;
        }
        const std::size_t count = baseline.size();
        double mean = 0, square = 0;
        for (std::size_t c = 0; c < count; ++c) {
            const double u = std::max(0.0, taxels.values[nearest * count + c] - baseline[c]);
            mean += u / static_cast<double>(count);
            square += u * u / static_cast<double>(count);
        }
        frame.v = (square - mean * mean) / (mean * mean);
        frames.push_back(frame);
    }
    return frames;
}

}  // namespace tacto::test
