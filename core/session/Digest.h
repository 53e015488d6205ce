// Digest.h - checksums and hashes of the session file, for profiles, limit sets, scripts and its own rows.
//
// Thread-safety: pure functions; an object has one owner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

}  // namespace tacto
