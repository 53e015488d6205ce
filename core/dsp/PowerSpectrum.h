// PowerSpectrum.h - power of a few axes in frequency bands, over one window (Hann by default).
//
// One-sided density S[k] = c_k |X[k]|² / (rate · Σw²), axes summed, no detrending (science.md section 2.3). The FFTW
// plan is made once, with FFTW_ESTIMATE. A measured plan may differ from run to run, and with it the last digits.
//
// Thread-safety: none; one owner. Construction and destruction may run on several threads (FFTW has one planner per
// process, which is guarded here). transform() and power() do not allocate.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

struct fftw_plan_s;

namespace tacto {

/// Bins first to last, both included; empty if first > last.
struct BinRange {
    std::size_t first = 1;
    std::size_t last = 0;
    [[nodiscard]] bool empty() const noexcept { return first > last; }
};

/// Returns the periodic Hann window: w[i] = ½ - ½ cos(2πi/n).
[[nodiscard]] std::vector<double> hannWindow(std::size_t length);

class PowerSpectrum {
public:
    /// Uses a Hann window of `length` ≥ 2 samples, for 1 or more axes.
    PowerSpectrum(std::size_t length, std::size_t axes, double rate_hz);
    /// Uses the given window; its size is the number of samples.
    PowerSpectrum(std::vector<double> window, std::size_t axes, double rate_hz);
    ~PowerSpectrum();
    PowerSpectrum(const PowerSpectrum&) = delete;
    PowerSpectrum& operator=(const PowerSpectrum&) = delete;

    /// Multiplies axis[i][0..length) by the window and transforms it, for each axis.
    void transform(std::span<const double* const> axis) noexcept;

    /// Returns S[k] of the last transform, in unit² / Hz.
    [[nodiscard]] double density(std::size_t bin) const noexcept;
    /// Returns Σ S·Δf over the bins: the mean square, in unit².
    [[nodiscard]] double power(BinRange bins) const noexcept;

    /// Returns the bins with frequencies from low to high, both included, with a tolerance for rounding: a rate
    /// measured from printed stamps may move a bin slightly beyond the end.
    [[nodiscard]] BinRange bins(double low_hz, double high_hz) const noexcept;
    [[nodiscard]] std::size_t length() const noexcept { return length_; }
    [[nodiscard]] double binWidth_hz() const noexcept { return rate_ / static_cast<double>(length_); }

private:
    const std::size_t length_;
    const std::size_t axes_;
    const double rate_;
    const std::size_t inputStride_;   // doubles between axes; keeps every axis aligned
    const std::size_t outputStride_;  // number of complex values between axes
    const std::vector<double> window_;
    double scale_ = 0;               // 2 / (rate · Σw²)
    double* input_ = nullptr;        // owned; from fftw_malloc
    double (*output_)[2] = nullptr;  // owned; from fftw_malloc
    fftw_plan_s* plan_ = nullptr;    // owned
};

// Periodic windows for a spectrum, with their noise bandwidths and effects; and the peaks of a spectrum.
//
//   rectangular      1.00 bins  finest frequency, level right only for whole periods; leaks far
//   Hann             1.50 bins  the usual one; level of a sine up to 1.4 dB low between two bins
//   Blackman-Harris  2.00 bins  four terms, side lobes below -92 dB: small lines beside large ones
//   flat top         3.77 bins  five terms; level of a sine right within 0.01 dB wherever it lies
//
// Coefficients: F. J. Harris (Proc. IEEE 66, 1978); flat top: D'Antona and Ferrero (Digital Signal Processing for
// Measurement Systems, 2006).

enum class SpectralWindow { Rectangular, Hann, BlackmanHarris, FlatTop };
inline constexpr std::array kSpectralWindows{SpectralWindow::Hann, SpectralWindow::FlatTop,
                                             SpectralWindow::BlackmanHarris, SpectralWindow::Rectangular};

/// Returns the name used in files: "hann".
[[nodiscard]] std::string_view nameOf(SpectralWindow window) noexcept;

[[nodiscard]] std::vector<double> samplesOf(SpectralWindow window, std::size_t length);

/// Returns n Σw² / (Σw)², in bins: the power of a sine is the density at its peak, times this bandwidth, times the
/// width of a bin. NaN for an empty window.
[[nodiscard]] double equivalentNoiseBandwidth(std::span<const double> window) noexcept;

/// Returns the number of bins from the middle of a line to the next zero.
[[nodiscard]] std::size_t mainLobe(SpectralWindow window) noexcept;

struct SpectralPeak {
    double bin = 0;    ///< position of the peak in bins, from a parabola through the logarithms of three bins
    double level = 0;  ///< level of the peak's highest bin
};
/// Returns up to `most` of the highest local maxima of `level` (amplitudes per bin, 0 or more), highest first. Each is
/// the largest within `apart` bins and at least `above` times the median of all levels.
[[nodiscard]] std::vector<SpectralPeak> spectralPeaks(std::span<const double> level, std::size_t apart, double above,
                                                      std::size_t most);

}  // namespace tacto
