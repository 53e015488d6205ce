// PowerSpectrum.h - power of a few axes in frequency bands, over one window: Hann, or another that is given.
//
// One-sided density S[k] = c_k |X[k]|² / (rate · Σw²), axes summed, no detrending (science.md section 2.3).
// The plan is made once, with FFTW_ESTIMATE: a measured plan may differ from run to run, and so would bytes.
//
// Thread-safety: none; one owner. Construction and destruction may run on several threads (FFTW's planner is
// one per process and guarded here). transform() and power() do not allocate.
#pragma once

#include <cstddef>
#include <span>
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
    /// With as many samples as the window has.
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

}  // namespace tacto
