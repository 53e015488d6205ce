// AccelerationTrack.h - filters acceleration with a band-pass and selects the windows that become frames.
//
// A window never spans a gap, a NaN or a clock step. After each of these the filter restarts in the steady state of the
// next sample, and the windows start there too.
//
// Thread-safety: none; one owner. Never allocates after construction.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/Stream.h"
#include "core/dsp/Butterworth.h"

namespace tacto {

/// A complete window of acceleration. It is identified by the number of its first sample.
struct AccelerationWindow {
    std::size_t first;
    double begin_s;
    double centre_s;
    double end_s;   ///< time of the last sample, at the nominal rate
    double last_s;  ///< its stamp
};

class AccelerationTrack {
public:
    static constexpr double kLow_hz = 5;
    static constexpr double kHigh_hz = 1000;
    static constexpr double kWindow_s = 0.064;
    static constexpr double kHop_s = 0.016;
    static constexpr std::size_t kChunk = 256;  ///< largest number of samples per push()

    explicit AccelerationTrack(const StreamInfo& info);

    /// Takes up to kChunk samples, filters them, and queues the windows that they complete. Not allowed while full().
    void push(std::span<const double> stamps, const double* values) noexcept;
    void clear() noexcept;

    [[nodiscard]] double first_s() const noexcept { return first_; }
    /// Returns the stamp of the newest valid sample; -infinity before the first.
    [[nodiscard]] double newest_s() const noexcept { return newest_; }

    /// Samples from number `from` on, with stamps up to `until_s`, that are not normalised yet.
    struct Stretch {
        std::span<const double> stamps;
        std::array<double*, AxesBandpass::kMaxAxes> axes;
    };
    [[nodiscard]] Stretch unnormalised(double until_s) noexcept;
    /// Tells the track that the caller normalised `count` samples.
    void markNormalised(std::size_t count) noexcept { normalised_ += count; }
    [[nodiscard]] std::size_t normalised() const noexcept { return normalised_; }

    [[nodiscard]] const AccelerationWindow* frontWindow() const noexcept;
    [[nodiscard]] std::array<const double*, AxesBandpass::kMaxAxes> samples(
        const AccelerationWindow& window) const noexcept;
    [[nodiscard]] std::span<const double> stamps(const AccelerationWindow& window) const noexcept {
        return std::span(stamps_).subspan(window.first - offset_, length_);
    }
    void popWindow() noexcept;
    /// Returns true if the next push() may not fit: the oldest windows must be removed first.
    [[nodiscard]] bool full() const noexcept;

    [[nodiscard]] std::size_t windowLength() const noexcept { return length_; }
    [[nodiscard]] double hop_s() const noexcept { return static_cast<double>(hop_) / rate_; }
    [[nodiscard]] double upperEdge_hz() const noexcept { return upperEdge_; }
    [[nodiscard]] bool bandTruncated() const noexcept { return truncated_; }

    struct Losses {
        std::size_t gaps = 0;
        std::size_t repeats = 0;
        std::size_t clockSteps = 0;
        std::size_t invalid = 0;
        std::size_t beyond = 0;  ///< number of implausibly large samples (SampleHistory.h)
    };
    [[nodiscard]] const Losses& losses() const noexcept { return losses_; }

private:
    enum class Use { Continue, Begin, Skip };
    [[nodiscard]] Use judge(double t_s, const double* sample) noexcept;
    void begin(double t_s, const double* sample) noexcept;
    void append(std::span<const double> stamps, const double* values) noexcept;
    void queueWindows() noexcept;
    void makeRoom(std::size_t count) noexcept;
    [[nodiscard]] std::size_t oldestNeeded() const noexcept;
    /// Returns false for implausible samples and for NaN.
    [[nodiscard]] bool plausible(const double* sample) const noexcept;

    // Constant after construction:
    const std::size_t axes_;
    const double rate_;
    const double most_;
    const std::size_t length_;
    const std::size_t hop_;
    const bool truncated_;
    const double upperEdge_;
    const std::size_t softLimit_;  // samples stored before they are moved to the front; small enough for the cache

    AxesBandpass filter_;
    SampleGrid grid_;
    std::array<std::vector<double>, AxesBandpass::kMaxAxes> filtered_;
    std::vector<double> stamps_;
    std::vector<AccelerationWindow> windows_;  // ring buffer
    std::size_t windowsFront_ = 0;
    std::size_t waiting_ = 0;
    std::size_t offset_ = 0;      // number of the sample at stamps_[0]
    std::size_t end_ = 0;         // number of the next sample
    std::size_t normalised_ = 0;  // samples with lower numbers are normalised
    std::size_t nextWindow_ = 0;  // number of the next window's first sample
    double anchor_ = 0;           // stamp that is the origin of window times
    std::size_t hops_ = 0;        // number of hops since the anchor
    double first_ = 0;
    double newest_ = 0;
    bool running_ = false;  // true: the next regular sample continues the stretch
    Losses losses_;
};

}  // namespace tacto
