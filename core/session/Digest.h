// Digest.h - checksums and hashes of the session file, for profiles, limit sets, scripts and its own rows.
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

/// 32 bytes: a SHA-256 of a row, or a BLAKE2b-256 of a chunk's samples.
using Digest = std::array<unsigned char, 32>;

/// SHA-256, as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256Hex(std::string_view bytes);
[[nodiscard]] Digest sha256(std::string_view bytes);

/// BLAKE2b with 32 bytes of output over `parts` one after the other. Used for bulk data because libsodium's runs
/// several times faster than its SHA-256; the chain that binds these digests is SHA-256.
[[nodiscard]] Digest bulkDigest(std::span<const std::span<const std::byte>> parts);

/// CRC-32 (zlib's) of `parts` one after the other.
[[nodiscard]] std::uint32_t crc32(std::span<const std::span<const std::byte>> parts);

[[nodiscard]] std::string hexText(const Digest& digest);

// One row of the log and the hash that ties it to all rows before it.
//
// hash = SHA-256 over the previous row's hash (32 bytes; zeros before the first row) followed by the text
//   seq \n t_ns \n kind \n <bytes of name>:name \n <bytes of body>:body \n digest in hexadecimal, or - \n
// so that anyone can recompute it without this program.

struct Entry {
    std::int64_t seq = 0;
    std::string_view kind;
    std::int64_t t_ns = 0;
    std::string_view name;
    std::string_view body;         ///< JSON
    std::optional<Digest> digest;  ///< digest of the chunk or capture that belongs to the row
};

[[nodiscard]] Digest chainHash(const Digest& previous, const Entry& entry);

}  // namespace tacto
