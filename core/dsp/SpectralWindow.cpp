#include "core/dsp/SpectralWindow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/Words.h"

namespace tacto {

namespace {

/// a0 - a1 cos x + a2 cos 2x - a3 cos 3x + a4 cos 4x
using Terms = std::array<double, 5>;

constexpr Terms termsOf(SpectralWindow window) noexcept {
    switch (window) {
        case SpectralWindow::Rectangular:
            break;
        case SpectralWindow::Hann:
            return {0.5, 0.5, 0, 0, 0};
        case SpectralWindow::BlackmanHarris:
            return {0.35875, 0.48829, 0.14128, 0.01168, 0};
        case SpectralWindow::FlatTop:
            return {0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368};
    }
    return {1, 0, 0, 0, 0};
}

constexpr Word<SpectralWindow> kSpectralWindowWords[] = {{"rectangular", SpectralWindow::Rectangular},
                                                         {"hann", SpectralWindow::Hann},
                                                         {"blackman-harris", SpectralWindow::BlackmanHarris},
                                                         {"flat-top", SpectralWindow::FlatTop}};

}  // namespace

std::string_view nameOf(SpectralWindow window) noexcept { return wordFor(kSpectralWindowWords, window); }

std::vector<double> samplesOf(SpectralWindow window, std::size_t length) {
    const auto terms = termsOf(window);
    std::vector<double> samples(length);
    for (std::size_t i = 0; i < length; ++i) {
        const double x = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length);
        double sum = 0, sign = 1;
        for (std::size_t k = 0; k < terms.size(); ++k, sign = -sign) {
            sum += sign * terms[k] * std::cos(static_cast<double>(k) * x);
        }
        samples[i] = sum;
    }
    return samples;
}

double equivalentNoiseBandwidth(std::span<const double> window) noexcept {
    double sum = 0, squares = 0;
    for (const double w : window) {
        sum += w;
        squares += w * w;
    }
    return static_cast<double>(window.size()) * squares / (sum * sum);
}

std::size_t mainLobe(SpectralWindow window) noexcept {
    const auto terms = termsOf(window);
    std::size_t highest = 0;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        if (terms[k] != 0) highest = k;
    }
    return highest + 1;
}

std::vector<SpectralPeak> spectralPeaks(std::span<const double> level, std::size_t apart, double above,
                                        std::size_t most) {
    std::vector<SpectralPeak> peaks;
    if (level.size() < 3) return peaks;
    std::vector<double> sorted(level.begin(), level.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double least = above * *middle;
    for (std::size_t k = 1; k + 1 < level.size(); ++k) {
        if (!(level[k] > 0) || !(level[k] >= least) || !(level[k] > level[k - 1]) || level[k] < level[k + 1]) continue;
        const std::size_t from = k > apart ? k - apart : 0, to = std::min(level.size() - 1, k + apart);
        const auto around = level.subspan(from, to - from + 1);
        if (*std::max_element(around.begin(), around.end()) > level[k]) continue;
        double off = 0;
        if (level[k - 1] > 0 && level[k + 1] > 0) {
            const double a = std::log(level[k - 1]), b = std::log(level[k]), c = std::log(level[k + 1]);
            const double bend = a - 2 * b + c;
            if (bend < 0) off = std::clamp(0.5 * (a - c) / bend, -0.5, 0.5);
        }
        peaks.push_back({static_cast<double>(k) + off, level[k]});
    }
    std::stable_sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.level > b.level; });
    if (peaks.size() > most) peaks.resize(most);
    return peaks;
}

}  // namespace tacto
