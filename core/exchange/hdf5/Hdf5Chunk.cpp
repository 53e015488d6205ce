#include "core/exchange/hdf5/Hdf5Chunk.h"

#include <cstdint>
#include <libdeflate.h>

namespace tacto {

namespace {

constexpr int kLevel = 2;  // of libdeflate: from here on the result is no larger than zlib's at level 4

/// Puts the first bytes of all numbers before all second ones, and so on.
void shuffle(std::span<const std::byte> bytes, std::size_t width, std::vector<std::byte>& into) {
    into.resize(bytes.size());
    const auto numbers = bytes.size() / width;
    for (std::size_t b = 0; b < width; ++b) {
        const auto* from = bytes.data() + b;
        auto* to = into.data() + b * numbers;
        for (std::size_t i = 0; i < numbers; ++i) to[i] = from[i * width];
    }
}

/// Fletcher's sum of big-endian words of 16 bits, the last filled up with zero. A sum that is a multiple of 65535 is
/// stored as 65535, and as 0 only where all words are 0.
std::uint32_t fletcher32(std::span<const std::byte> bytes) {
    std::uint64_t first = 0, second = 0;  // 2³² bytes are too few to overflow
    const auto add = [&](std::byte high, std::byte low) {
        first += std::to_integer<std::uint64_t>(high) << 8U | std::to_integer<std::uint64_t>(low);
        second += first;
    };
    std::size_t i = 0;
    for (; i + 1 < bytes.size(); i += 2) add(bytes[i], bytes[i + 1]);
    if (i < bytes.size()) add(bytes[i], std::byte{0});
    const auto folded = [](std::uint64_t sum) {
        constexpr std::uint64_t kMaxFolded = 0xFFFF;
        return static_cast<std::uint32_t>(sum == 0 ? 0 : (sum - 1) % kMaxFolded + 1);
    };
    return folded(second) << 16U | folded(first);
}

}  // namespace

void Hdf5Chunk::Freed::operator()(libdeflate_compressor* compressor) const noexcept {
    libdeflate_free_compressor(compressor);
}

Result<std::span<const std::byte>> Hdf5Chunk::packed(std::span<const std::byte> bytes, std::size_t width) {
    constexpr std::size_t kSum = 4;
    if (!compressor_) compressor_.reset(libdeflate_alloc_compressor(kLevel));
    if (!compressor_) return fail(ErrorCode::Io, "there is no memory to compress in");
    shuffle(bytes, width, shuffled_);
    packed_.resize(libdeflate_zlib_compress_bound(compressor_.get(), bytes.size()) + kSum);
    const auto size = libdeflate_zlib_compress(compressor_.get(), shuffled_.data(), shuffled_.size(), packed_.data(),
                                               packed_.size() - kSum);
    if (size == 0) return fail(ErrorCode::Io, "a chunk of {} bytes could not be compressed", bytes.size());
    const auto sum = fletcher32(std::span(packed_).first(size));
    for (std::size_t b = 0; b < kSum; ++b) packed_[size + b] = static_cast<std::byte>(sum >> (8 * b));
    return std::span<const std::byte>(packed_).first(size + kSum);
}

}  // namespace tacto
