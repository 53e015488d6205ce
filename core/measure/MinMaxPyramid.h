// MinMaxPyramid.h - the smallest and the largest sample of any stretch of a long record, at the price of a short one.
//
// Ten million samples on a thousand pixel columns are drawn from their extremes: the pyramid keeps the extremes of
// every block of 64 samples, of every 8 blocks, of every 8 of those, and so on. A stretch that cuts through blocks is
// answered from the samples at its ends, so the answer is exact at any zoom. A missing sample (NaN) is never an
// extreme; that it is missing is remembered beside them.
//
// The samples stay the caller's: extend() is given the whole record each time it grows (or moves in memory), and
// only what is new is read.
//
// Thread-safety: extend() and clear() by one owner; several threads may read while it is not extended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tacto {

/// Extremes of a stretch, in the samples' unit.
struct Envelope {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    bool gap = false;  ///< a sample in it is missing

    /// Whether there is no sample, or none that is a number.
    [[nodiscard]] bool empty() const noexcept { return low > high; }
    bool operator==(const Envelope&) const = default;
};

class MinMaxPyramid {
public:
    static constexpr std::size_t kBlock = 64;  ///< samples in a block of the lowest level
    static constexpr std::size_t kFan = 8;     ///< blocks in one of the next level

    /// `record` is all samples so far: those seen before, unchanged, and any number of new ones. It must stay where it
    /// is until the next extend(), clear() or the end of this. A shorter record than before starts over.
    void extend(std::span<const float> record);
    void clear() noexcept;

    [[nodiscard]] std::size_t samples() const noexcept { return record_.size(); }

    /// The extremes of the samples first..last-1; what lies beyond the record is left out. Exact.
    [[nodiscard]] Envelope over(std::size_t first, std::size_t last) const noexcept;

private:
    /// Whole blocks only: what is left over is read from the level below.
    struct Level {
        std::vector<float> low;
        std::vector<float> high;
        std::vector<std::uint8_t> gap;
        [[nodiscard]] std::size_t size() const noexcept { return low.size(); }
        void resize(std::size_t blocks);
    };

    void mergeBlocks(const Level& level, std::size_t first, std::size_t last, Envelope& into) const noexcept;

    std::span<const float> record_;
    std::vector<Level> levels_;
};

}  // namespace tacto
