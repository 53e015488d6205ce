// SealedText.h - encrypts bytes with XChaCha20-Poly1305-IETF and a random nonce: padded, so that the length reveals
// little, and bound to a place by additional data that are not stored.
//
// 24 bytes of nonce, then the ciphertext with its tag of 16 bytes; texts are URL-safe base64 without padding
//
// Thread-safety: pure functions, except for the system's random numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/seal/Secret.h"

namespace tacto {

inline constexpr std::size_t kKeyBytes = 32;
/// Lengths are rounded up to multiples of these (sodium_pad), so that "none" is as long as "rough-high".
inline constexpr std::size_t kTextBlock = 256;
inline constexpr std::size_t kChunkBlock = 4096;

/// `key` must have kKeyBytes bytes.
[[nodiscard]] std::vector<std::byte> sealBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                               std::span<const std::span<const std::byte>> parts);
/// Errors: ParseError unless `key` sealed the bytes for `boundTo` with `block`.
[[nodiscard]] Result<Secret> openSecret(const Secret& key, std::string_view boundTo, std::size_t block,
                                        std::span<const std::byte> sealed);
[[nodiscard]] Result<std::vector<std::byte>> openBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                                       std::span<const std::byte> sealed);

[[nodiscard]] std::string base64Text(std::span<const std::byte> bytes);
/// Decodes base64. Errors: ParseError.
[[nodiscard]] Result<std::vector<std::byte>> bytesOfBase64(std::string_view text);

/// Seals and opens texts, with kTextBlock.
[[nodiscard]] std::string sealText(const Secret& key, std::string_view boundTo, std::string_view text);
[[nodiscard]] Result<std::string> openText(const Secret& key, std::string_view boundTo, std::string_view sealed);

/// Returns a keyed hash of `text` (BLAKE2b, 64 hexadecimal digits), which nobody can make without `key`.
[[nodiscard]] std::string macText(const Secret& key, std::string_view text);

/// Returns subkey `number` of `key`, with kKeyBytes bytes (crypto_kdf, context "tactpart").
[[nodiscard]] Secret subkey(const Secret& key, std::uint64_t number);

/// Returns `digits` (an even number of) random hexadecimal digits.
[[nodiscard]] std::string randomHex(std::size_t digits);
/// Returns a uniform random number from 0 to bound-1.
[[nodiscard]] std::uint32_t randomBelow(std::uint32_t bound);

}  // namespace tacto
