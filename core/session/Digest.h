// Digest.h - checksums and hashes of session rows and samples, and of profiles, limit sets and scripts.
//
// Thread-safety: pure functions; an object has one owner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tacto {

/// 32 bytes: the SHA-256 of a row, or the BLAKE2b-256 of a chunk's samples.
using Digest = std::array<unsigned char, 32>;

/// Returns the SHA-256 as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256Hex(std::string_view bytes);
[[nodiscard]] Digest sha256(std::string_view bytes);

/// Returns the BLAKE2b hash (32 bytes) of `parts` joined together. Used for bulk data, because libsodium's BLAKE2b is
/// several times faster than its SHA-256; the hash chain that contains these digests uses SHA-256.
[[nodiscard]] Digest bulkDigest(std::span<const std::span<const std::byte>> parts);

/// Returns the CRC-32 (as in zlib) of `parts` joined together.
[[nodiscard]] std::uint32_t crc32(std::span<const std::span<const std::byte>> parts);

[[nodiscard]] std::string hexText(const Digest& digest);

// One row of the log, and the hash that links the row to all rows before it.
//
// hash = SHA-256 over the previous row's hash (32 bytes; zeros before the first row) followed by the text
//   seq \n t_ns \n kind \n <bytes of name>:name \n <bytes of body>:body \n digest in hexadecimal, or - \n
// so that anyone can compute the hash again without this program.

struct Entry {
    std::int64_t seq = 0;
    std::string_view kind;
    std::int64_t t_ns = 0;
    std::string_view name;
    std::string_view body;         ///< JSON
    std::optional<Digest> digest;  ///< of the chunk or capture that belongs to the row
};

[[nodiscard]] Digest chainHash(const Digest& previous, const Entry& entry);

}  // namespace tacto
