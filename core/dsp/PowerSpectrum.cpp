#include "core/dsp/PowerSpectrum.h"

#include <algorithm>
#include <cmath>
#include <fftw3.h>
#include <limits>
#include <mutex>
#include <new>
#include <numbers>
#include <utility>

#include "core/base/Words.h"

namespace tacto {

namespace {
std::mutex& planner() {
    static std::mutex guard;
    return guard;
}

constexpr std::size_t padded(std::size_t count, std::size_t multiple) {
    return (count + multiple - 1) / multiple * multiple;
}

// A band's end may miss its bin only by the rounding of a measured rate.
constexpr double kEndTolerance = 1e-9;
}  // namespace

std::vector<double> hannWindow(std::size_t length) {
    std::vector<double> window(length);
    for (std::size_t i = 0; i < length; ++i) {
        window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length));
    }
    return window;
}

PowerSpectrum::PowerSpectrum(std::size_t length, std::size_t axes, double rate_hz)
    : PowerSpectrum(hannWindow(length), axes, rate_hz) {}

PowerSpectrum::PowerSpectrum(std::vector<double> window, std::size_t axes, double rate_hz)
    : length_(window.size()),
      axes_(axes),
      rate_(rate_hz),
      inputStride_(padded(length_, 8)),
      outputStride_(padded(length_ / 2 + 1, 4)),
      window_(std::move(window)) {
    double sum = 0;
    for (const double w : window_) sum += w * w;
    scale_ = 2 / (rate_hz * sum);

    const std::lock_guard lock(planner());
    input_ = fftw_alloc_real(inputStride_ * axes_);
    output_ = fftw_alloc_complex(outputStride_ * axes_);
    if (input_ == nullptr || output_ == nullptr) {
        fftw_free(input_);
        fftw_free(output_);
        throw std::bad_alloc();
    }
    std::fill_n(input_, inputStride_ * axes_, 0.0);
    std::fill_n(&output_[0][0], 2 * outputStride_ * axes_, 0.0);
    const int n = static_cast<int>(length_);
    plan_ = fftw_plan_many_dft_r2c(1, &n, static_cast<int>(axes_), input_, nullptr, 1, static_cast<int>(inputStride_),
                                   output_, nullptr, 1, static_cast<int>(outputStride_), FFTW_ESTIMATE);
}

PowerSpectrum::~PowerSpectrum() {
    const std::lock_guard lock(planner());
    fftw_destroy_plan(plan_);
    fftw_free(input_);
    fftw_free(output_);
}

void PowerSpectrum::transform(std::span<const double* const> axis) noexcept {
    for (std::size_t a = 0; a < axes_; ++a) {
        const double* from = axis[a];
        double* to = input_ + a * inputStride_;
        for (std::size_t i = 0; i < length_; ++i) to[i] = from[i] * window_[i];
    }
    fftw_execute(plan_);
}

double PowerSpectrum::density(std::size_t bin) const noexcept {
    double sum = 0;
    for (std::size_t a = 0; a < axes_; ++a) {
        const auto& x = output_[a * outputStride_ + bin];
        sum += x[0] * x[0] + x[1] * x[1];
    }
    const bool single = bin == 0 || (length_ % 2 == 0 && bin == length_ / 2);
    return sum * scale_ * (single ? 0.5 : 1.0);
}

double PowerSpectrum::power(BinRange bins) const noexcept {
    if (bins.empty()) return 0;
    double sum = 0;
    for (std::size_t a = 0; a < axes_; ++a) {
        const double(*x)[2] = output_ + a * outputStride_;
        // Four separate sums, so that no addition waits for the one before.
        double part[4] = {};
        std::size_t k = bins.first;
        for (; k + 1 <= bins.last; k += 2) {
            part[0] += x[k][0] * x[k][0];
            part[1] += x[k][1] * x[k][1];
            part[2] += x[k + 1][0] * x[k + 1][0];
            part[3] += x[k + 1][1] * x[k + 1][1];
        }
        if (k == bins.last) {
            part[0] += x[k][0] * x[k][0];
            part[1] += x[k][1] * x[k][1];
        }
        sum += (part[0] + part[2]) + (part[1] + part[3]);
    }
    double power = sum * scale_;
    if (bins.first == 0) power -= density(0);
    if (length_ % 2 == 0 && bins.last == length_ / 2) power -= density(length_ / 2);
    return power * binWidth_hz();
}

BinRange PowerSpectrum::bins(double low_hz, double high_hz) const noexcept {
    const double width = binWidth_hz();
    const double first = std::ceil(low_hz / width * (1 - kEndTolerance));
    const double last = std::floor(high_hz / width * (1 + kEndTolerance));
    if (!(first <= last) || !(last >= 0)) return {};
    return {static_cast<std::size_t>(std::max(first, 0.0)), std::min(static_cast<std::size_t>(last), length_ / 2)};
}

namespace {

/// Coefficients of a0 - a1 cos x + a2 cos 2x - a3 cos 3x + a4 cos 4x.
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
