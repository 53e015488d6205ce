// SampleBlocks.h - keeps the extremes of every 256 samples of a record, to find samples beyond a threshold without
// reading the silence between them. Private to core/measure.
//
// One pass over the samples makes the blocks. The searches for signal levels, pulses and clipping look at the blocks
// first. A missing (NaN) or infinite sample is never an extreme and never beyond a threshold.
//
// Thread-safety: immutable after construction. The caller keeps the samples, which must outlive this object.
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

    /// Extremes of the whole record. The third from outside is an extreme without two glitches. Infinite if there are
    /// too few samples.
    [[nodiscard]] float lowest() const noexcept { return lowest_; }
    [[nodiscard]] float highest() const noexcept { return highest_; }
    [[nodiscard]] float thirdLowest() const noexcept { return thirdLowest_; }
    [[nodiscard]] float thirdHighest() const noexcept { return thirdHighest_; }

    /// Returns the first sample at or after `from` that is below `below` or above `above`, or samples().size() if none.
    [[nodiscard]] std::size_t nextBeyond(std::size_t from, float below, float above) const noexcept;

    /// Returns whether the block of sample `i` spans more than `by`, or may hold an infinite or missing sample.
    [[nodiscard]] bool moves(std::size_t i, float by) const noexcept {
        return !complete() || high_[i / kSamples] - low_[i / kSamples] > by;
    }

    /// Returns false if no sample from `first` to before `end` is at or below `low`, or at or above `high`. This is a
    /// quick check: true promises nothing. An infinite sample reaches every limit.
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

// The samples of a channel that are measured: as recorded, without drift, or as means of several samples. Private to
// core/measure.

/// Movable: `samples` refers to the channel's samples or to `own`.
struct SampleView {
    const Capture* capture = nullptr;
    const CaptureChannel* channel = nullptr;
    std::vector<float> own{};
    std::span<const float> samples{};
    std::size_t mean = 1;  ///< number of recorded samples in each of `samples`
    double rate_hz = 0;
    double start_s = 0;  ///< time of the first of `samples`: the middle of the averaged samples

    /// Converts a time to a position in `samples`, fractions included, and back.
    [[nodiscard]] double positionOf(double time_s) const noexcept { return (time_s - start_s) * rate_hz; }
    [[nodiscard]] double timeOf(double position) const noexcept { return start_s + position / rate_hz; }
};

[[nodiscard]] SampleView asRecorded(const Capture& capture, const CaptureChannel& channel);

/// Returns `view` with every `mean` samples averaged into one; a remainder at the end is dropped. White noise falls by
/// √mean. The mean is missing if one of its samples is.
[[nodiscard]] SampleView averaged(const SampleView& view, std::size_t mean);

}  // namespace tacto
