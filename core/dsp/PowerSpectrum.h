// PowerSpectrum.h - power of a few axes in frequency bands, over one window: Hann, or another that is given.
//
// One-sided density S[k] = c_k |X[k]|² / (rate · Σw²), axes summed, no detrending (science.md section 2.3).
// The plan is made once, with FFTW_ESTIMATE: a measured plan may differ from run to run, and so would bytes.
//
// Thread-safety: none; one owner. Construction and destruction may run on several threads (FFTW's planner is
// one per process and guarded here). transform() and power() do not allocate.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

struct fftw_plan_s;

namespace tacto {

/// Bins first..last, both included; empty when first > last.
struct BinRange {
    std::size_t first = 1;
    std::size_t last = 0;
    [[nodiscard]] bool empty() const noexcept { return first > last; }
};

/// w[i] = ½ - ½ cos(2πi/n): the periodic Hann window.
[[nodiscard]] std::vector<double> hannWindow(std::size_t length);

class PowerSpectrum {
public:
    /// `length` ≥ 2 samples, 1 or more axes.
    PowerSpectrum(std::size_t length, std::size_t axes, double rate_hz);
    /// Computes it from as many samples as the window has.
    PowerSpectrum(std::vector<double> window, std::size_t axes, double rate_hz);
    ~PowerSpectrum();
    PowerSpectrum(const PowerSpectrum&) = delete;
    PowerSpectrum& operator=(const PowerSpectrum&) = delete;

    /// Windows and transforms axis[i][0..length) for each axis.
    void transform(std::span<const double* const> axis) noexcept;

    /// S[k] of the last transform, unit² / Hz.
    [[nodiscard]] double density(std::size_t bin) const noexcept;
    /// Σ S·Δf over the bins: mean square, unit².
    [[nodiscard]] double power(BinRange bins) const noexcept;

    /// The bins whose frequency lies in low..high, both ends included (a rate measured from printed stamps may put
    /// a bin a rounding error beyond an end it stands on).
    [[nodiscard]] BinRange bins(double low_hz, double high_hz) const noexcept;
    [[nodiscard]] std::size_t length() const noexcept { return length_; }
    [[nodiscard]] double binWidth_hz() const noexcept { return rate_ / static_cast<double>(length_); }

private:
    const std::size_t length_;
    const std::size_t axes_;
    const double rate_;
    const std::size_t inputStride_;   // doubles between axes, keeps every axis aligned
    const std::size_t outputStride_;  // complex values between axes
    const std::vector<double> window_;
    double scale_ = 0;               // 2 / (rate · Σw²)
    double* input_ = nullptr;        // owned, fftw_malloc
    double (*output_)[2] = nullptr;  // owned, fftw_malloc
    fftw_plan_s* plan_ = nullptr;    // owned
};

// Windows for a spectrum, periodic, and what they do to its levels; and the peaks of a spectrum.
//
//   rectangular      1.00 bins  finest frequency, level right only for whole periods; leaks far
//   Hann             1.50 bins  the usual one; level of a sine up to 1.4 dB low between two bins
//   Blackman-Harris  2.00 bins  four terms, side lobes below -92 dB: small lines beside large ones
//   flat top         3.77 bins  five terms; level of a sine right within 0.01 dB wherever it lies
//
// The coefficients are F. J. Harris's (Proc. IEEE 66, 1978) and, of the flat top, those of D'Antona and Ferrero
// (Digital Signal Processing for Measurement Systems, 2006).

enum class SpectralWindow { Rectangular, Hann, BlackmanHarris, FlatTop };
inline constexpr std::array kSpectralWindows{SpectralWindow::Hann, SpectralWindow::FlatTop,
                                             SpectralWindow::BlackmanHarris, SpectralWindow::Rectangular};

/// "hann": as it is stored.
[[nodiscard]] std::string_view nameOf(SpectralWindow window) noexcept;

[[nodiscard]] std::vector<double> samplesOf(SpectralWindow window, std::size_t length);

/// n Σw² / (Σw)², in bins: the power of a sine, spread over its bins, is the density at its peak times this and the
/// bin's width. NaN of an empty window.
[[nodiscard]] double equivalentNoiseBandwidth(std::span<const double> window) noexcept;

/// Bins from the middle of a line to the first zero beside it.
[[nodiscard]] std::size_t mainLobe(SpectralWindow window) noexcept;

struct SpectralPeak {
    double bin = 0;    ///< the bin, by a parabola through the logarithms of three bins
    double level = 0;  ///< level of the highest bin
};
/// The highest local maxima of `level` (an amplitude per bin, 0 and up), `most` at most, highest first: each the
/// largest within `apart` bins and at least `above` times the median of all.
[[nodiscard]] std::vector<SpectralPeak> spectralPeaks(std::span<const double> level, std::size_t apart, double above,
                                                      std::size_t most);

}  // namespace tacto
