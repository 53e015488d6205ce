// Hdf5Chunk.h - a chunk of numbers as HDF5's filters shuffle, deflate and Fletcher-32 store it.
//
// It is made here because the library deflates with zlib: libdeflate makes the same format in half the time, and no
// larger. Sources: HDF5 File Format Specification 3.0, IV.A.2.l; "HDF5 Library Filters".
//
// Thread-safety: one owner.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/Result.h"

struct libdeflate_compressor;

namespace tacto {

class Hdf5Chunk {
public:
    /// Parameter of the filter deflate, as it is stated in the file: what zlib would need for a chunk of this size.
    static constexpr unsigned kDeflate = 4;

    /// Returns what is stored of `bytes`, whole numbers of `width` bytes each; valid until the next call. The same
    /// bytes give the same result. Errors: Io, without memory.
    [[nodiscard]] Result<std::span<const std::byte>> packed(std::span<const std::byte> bytes, std::size_t width);

private:
    struct Freed {
        void operator()(libdeflate_compressor* compressor) const noexcept;
    };
    std::unique_ptr<libdeflate_compressor, Freed> compressor_;
    std::vector<std::byte> shuffled_, packed_;
};

}  // namespace tacto
