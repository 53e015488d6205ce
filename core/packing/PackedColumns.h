// PackedColumns.h - packs columns of samples without loss: whole numbers of a step, their differences, the bytes by
// their significance, all under zstd.
//
// A converter's values are whole numbers of a step: value = base + k * step, computed in double. A column is stored as
// its numbers k, and as rests: the 64 bits of each value minus the 64 bits of base + k * step, as integers modulo 2^64.
// Rests are 0 for most converters. A column without a step has k = 0, and its rests are the values' own bits. So every
// value comes back bit by bit, also -0 and the payload of a NaN.
//
// The packed bytes are one zstd frame with its content size in the header. All numbers are little-endian. The content:
//   for each column, 36 bytes: base and step (double); for its numbers and then its rests: start (int64), order and
//     width (one byte each)
//   for each byte 0 to 7 of the numbers: that byte of every sample of each column whose width is larger than it
//   the same for the rests
// The integers of order 0 are differences to start, those of order 1 differences to the integer before (the first: to
// start). A difference d is stored as (d << 1) ^ (d >> 63) in `width` bytes.
//
// Thread-safety: unpackColumns() is a pure function; a ColumnPacker has one owner.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

/// The name of this packing in the description of a chunk.
inline constexpr const char* kPackedAsSteps = "steps+zstd";

/// Larger chunks are stored as they are. So whoever unpacks a damaged chunk needs at most 150 bytes for each of these.
inline constexpr std::size_t kMaxPackedNumbers = std::size_t{1} << 20;

/// Packs the chunks of one stream; a column's step is looked for once, and again if it no longer fits.
class ColumnPacker {
public:
    ColumnPacker();
    ~ColumnPacker();
    ColumnPacker(ColumnPacker&&) noexcept;
    ColumnPacker& operator=(ColumnPacker&&) noexcept;

    /// Packs the stamps, if `withStamps`, as the first column, and then the values. The result is valid until the next
    /// call, and empty if packing would save less than a tenth. After chunks that did not shrink it tries only every
    /// sixteenth.
    [[nodiscard]] std::span<const std::byte> pack(const SampleBlock& block, bool withStamps);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Unpacks `samples` samples of `columns` columns; stamps only `withStamps`. Never allocates more than
/// kMaxPackedNumbers allows. Errors: ParseError if `packed` is not this many samples.
[[nodiscard]] Result<void> unpackColumns(std::span<const std::byte> packed, std::uint64_t samples, std::size_t columns,
                                         bool withStamps, SampleBlock& into);

}  // namespace tacto
