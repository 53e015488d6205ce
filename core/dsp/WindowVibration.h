// WindowVibration.h - computes the spectral feature and the mean square of one window of acceleration (science.md
// section 2.3).
//
// Thread-safety: none; one owner. Reading a window does not allocate.
#pragma once

#include <array>
#include <vector>

#include "core/dsp/AccelerationTrack.h"
#include "core/dsp/ForceTrack.h"
#include "core/dsp/PowerSpectrum.h"
#include "core/dsp/RoughnessSettings.h"

namespace tacto {

class WindowVibration {
public:
    /// Reads windows of `track`, which must outlive this object and has `axes` axes at `rate_hz`.
    WindowVibration(const AccelerationTrack& track, std::size_t axes, double rate_hz,
                    const RoughnessSettings& settings);

    /// Returns false if the rate is too low for the band of the spectral feature.
    [[nodiscard]] bool hasFeature() const noexcept { return !rough_.empty(); }

    struct Reading {
        double feature;  ///< h or h_abs, according to the settings; NaN if absent
        double meanSquare;
    };
    [[nodiscard]] Reading of(const AccelerationWindow& window) noexcept;
    /// Returns the mean square of the window, with the normalisation by `force` undone sample by sample. While a finger
    /// lands or lifts, force changes tenfold within a window; one number for all would turn sensor noise into vibration
    /// (hazard H7). `start_s`: the start of the stream.
    [[nodiscard]] double undoneMeanSquare(const AccelerationWindow& window, const ForceTrack& force,
                                          double start_s) noexcept;

private:
    const AccelerationTrack& track_;
    const std::size_t axes_;
    const SpectralFeature feature_;
    PowerSpectrum spectrum_;
    BinRange whole_, rough_;
    std::vector<double> divisors_;                                    // scratch: divisors of one window
    std::array<std::vector<double>, AxesBandpass::kMaxAxes> undone_;  // scratch: axes of one window
};

}  // namespace tacto
