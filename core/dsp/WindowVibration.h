// WindowVibration.h - the vibration of one window of acceleration: its spectral feature and its mean square
// (science.md section 2.3).
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
    /// Takes windows of `track`, which outlives this and has `axes` axes at `rate_hz`.
    WindowVibration(const AccelerationTrack& track, std::size_t axes, double rate_hz,
                    const RoughnessSettings& settings);

    /// False where the signal's rate is too low for the band of the spectral feature.
    [[nodiscard]] bool hasFeature() const noexcept { return !rough_.empty(); }

    struct Reading {
        double feature;  ///< h or h_abs, as the settings say; NaN: absent
        double meanSquare;
    };
    [[nodiscard]] Reading of(const AccelerationWindow& window) noexcept;
    /// The window's mean square with the normalisation by `force` undone sample by sample. While a finger lands or
    /// lifts, force changes tenfold within a window: undoing it with one number would make sensor noise a vibration
    /// (hazard H7). `start_s`: where the stream begins.
    [[nodiscard]] double undoneMeanSquare(const AccelerationWindow& window, const ForceTrack& force,
                                          double start_s) noexcept;

private:
    const AccelerationTrack& track_;
    const std::size_t axes_;
    const SpectralFeature feature_;
    PowerSpectrum spectrum_;
    BinRange whole_, rough_;
    std::vector<double> divisors_;                                    // scratch: one window's
    std::array<std::vector<double>, AxesBandpass::kMaxAxes> undone_;  // scratch: one window's axes
};

}  // namespace tacto
