// SpectralWindow.h - windows for a spectrum, periodic, and what they do to its levels; and the peaks of a spectrum.
//
//   rectangular      1.00 bins  finest frequency, level right only for whole periods; leaks far
//   Hann             1.50 bins  the usual one; level of a sine up to 1.4 dB low between two bins
//   Blackman-Harris  2.00 bins  four terms, side lobes below -92 dB: small lines beside large ones
//   flat top         3.77 bins  five terms; level of a sine right within 0.01 dB wherever it lies
//
// The coefficients are F. J. Harris's (Proc. IEEE 66, 1978) and, of the flat top, those of D'Antona and Ferrero
// (Digital Signal Processing for Measurement Systems, 2006).
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace tacto {

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
    double bin = 0;    ///< by parabola through the logarithms of three bins
    double level = 0;  ///< level of the highest bin
};
/// The highest local maxima of `level` (an amplitude per bin, 0 and up), `most` at most, highest first: each the
/// largest within `apart` bins and at least `above` times the median of all.
[[nodiscard]] std::vector<SpectralPeak> spectralPeaks(std::span<const double> level, std::size_t apart, double above,
                                                      std::size_t most);

}  // namespace tacto
