// SampleBlocks.h - the extremes of every 256 samples of a record, so that what lies beyond a threshold is found without
// reading the silence between. Private to core/measure.
//
// One pass over the samples makes the blocks; the levels of a signal, its pulses and its clipping then ask the blocks
// first. A sample that is missing (NaN) or infinite is neither an extreme nor beyond anything.
//
// Thread-safety: immutable after construction. The samples stay the caller's and must outlive this.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/Capture.h"

namespace tacto {

class SampleBlocks {
public:
    static constexpr std::size_t kSamples = 256;

    explicit SampleBlocks(std::span<const float> samples);

    [[nodiscard]] std::span<const float> samples() const noexcept { return samples_; }
    [[nodiscard]] std::size_t finite() const noexcept { return finite_; }
    [[nodiscard]] bool complete() const noexcept { return finite_ == samples_.size(); }

    /// Taken over the whole record; the third from outside is the extreme without two glitches. Infinite where there
    /// are fewer samples.
    [[nodiscard]] float lowest() const noexcept { return lowest_; }
    [[nodiscard]] float highest() const noexcept { return highest_; }
    [[nodiscard]] float thirdLowest() const noexcept { return thirdLowest_; }
    [[nodiscard]] float thirdHighest() const noexcept { return thirdHighest_; }

    /// The first sample at or after `from` that is below `below` or above `above`; samples().size() if none is.
    [[nodiscard]] std::size_t nextBeyond(std::size_t from, float below, float above) const noexcept;

    /// Whether the block of sample `i` spans more than `by`. An infinite or missing sample counts as such.
    [[nodiscard]] bool moves(std::size_t i, float by) const noexcept {
        return !complete() || high_[i / kSamples] - low_[i / kSamples] > by;
    }

    /// False where no sample from `first` to before `end` is at or below `low`, or at or above `high`; a quick look, so
    /// that true promises nothing. An infinite sample is at every limit.
    [[nodiscard]] bool mayReach(std::size_t first, std::size_t end, double low, double high) const noexcept;

private:
    std::span<const float> samples_;
    std::vector<float> low_;
    std::vector<float> high_;
    std::size_t finite_ = 0;
    float lowest_ = 0;
    float highest_ = 0;
    float thirdLowest_ = 0;
    float thirdHighest_ = 0;
};

// A channel as it is measured: as recorded, or without its drift, or as means of several samples.
// Private to core/measure.

/// Movable: `samples` looks at the channel's samples or at `own`.
struct SampleView {
    const Capture* capture = nullptr;
    const CaptureChannel* channel = nullptr;
    std::vector<float> own{};
    std::span<const float> samples{};
    std::size_t mean = 1;  ///< recorded samples in each of `samples`
    double rate_hz = 0;
    double start_s = 0;  ///< time of the first of `samples`: the middle of what it is the mean of

    /// The position in `samples`, fractions included, and back.
    [[nodiscard]] double positionOf(double time_s) const noexcept { return (time_s - start_s) * rate_hz; }
    [[nodiscard]] double timeOf(double position) const noexcept { return start_s + position / rate_hz; }
};

[[nodiscard]] SampleView asRecorded(const Capture& capture, const CaptureChannel& channel);

/// `view` with `mean` of its samples averaged into one; what is left over at the end is left out. White noise falls by
/// √mean. A mean over a missing sample is missing.
[[nodiscard]] SampleView averaged(const SampleView& view, std::size_t mean);

}  // namespace tacto
