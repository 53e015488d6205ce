// SampleBlocks.h - the extremes of every 256 samples of a record, so that what lies beyond a threshold is found without
// reading the silence between. Private to core/measure.
//
// One pass over the samples makes them; the levels of a signal, its pulses and its clipping then ask the blocks first.
// A sample that is missing (NaN) or infinite is neither an extreme nor beyond anything.
//
// Thread-safety: immutable after construction. The samples stay the caller's and must outlive this.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tacto {

class SampleBlocks {
public:
    static constexpr std::size_t kSamples = 256;

    explicit SampleBlocks(std::span<const float> samples);

    [[nodiscard]] std::span<const float> samples() const noexcept { return samples_; }
    [[nodiscard]] std::size_t finite() const noexcept { return finite_; }
    [[nodiscard]] bool complete() const noexcept { return finite_ == samples_.size(); }

    /// Over the whole record; the third from outside is the extreme without two glitches. Infinite where there are
    /// fewer samples.
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

}  // namespace tacto
