// MinMaxPyramid.h - quickly finds the smallest and the largest sample in any stretch of a long record.
//
// A plot of ten million samples on a thousand pixel columns shows the extremes in each column. The pyramid keeps the
// extremes of every block of 64 samples, of every 8 blocks, of every 8 of those, and so on. If a stretch cuts through
// blocks, its ends are read from the samples, so that the result is exact at any zoom. A missing sample (NaN) is never
// an extreme, but the pyramid remembers the gap.
//
// The caller keeps the samples. It calls extend() with the whole record each time the record grows (or moves in
// memory); only new samples are read.
//
// Thread-safety: extend() and clear() by one owner; several threads may read while it is not extended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tacto {

/// Lowest and highest sample of a stretch, in the samples' unit.
struct Envelope {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    bool gap = false;  ///< a sample of the stretch is missing

    /// Returns true if there is no sample, or no sample that is a number.
    [[nodiscard]] bool empty() const noexcept { return low > high; }
    bool operator==(const Envelope&) const = default;
};

class MinMaxPyramid {
public:
    static constexpr std::size_t kBlock = 64;  ///< samples in a block of the lowest level
    static constexpr std::size_t kFan = 8;     ///< blocks in a block of the next level

    /// `record` holds all samples so far: the earlier ones, unchanged, and any number of new ones. It must stay in
    /// place until the next extend(), clear() or the end of this object. A shorter record starts the pyramid over.
    void extend(std::span<const float> record);
    void clear() noexcept;

    [[nodiscard]] std::size_t samples() const noexcept { return record_.size(); }

    /// Returns the exact extremes of samples first to last-1; positions beyond the record are ignored.
    [[nodiscard]] Envelope over(std::size_t first, std::size_t last) const noexcept;

private:
    /// Holds whole blocks only: the remainder is read from the level below.
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
