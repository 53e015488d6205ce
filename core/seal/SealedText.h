// SealedText.h - bytes that only a key opens: XChaCha20-Poly1305-IETF with a random nonce, padded so that the length
// reveals little, bound to a place by additional data that are not stored.
//
//   24 bytes of nonce, then the ciphertext with its tag of 16 bytes; as text in URL-safe base64 without padding
//
// Thread-safety: pure functions, but for the system's random numbers.
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
/// Lengths are rounded up to multiples of this (sodium_pad), so that "none" is not shorter than "rough-high".
inline constexpr std::size_t kTextBlock = 256;
inline constexpr std::size_t kChunkBlock = 4096;

/// `key` has kKeyBytes bytes.
[[nodiscard]] std::vector<std::byte> sealBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                               std::span<const std::span<const std::byte>> parts);
/// Errors: ParseError for what `key` did not seal for `boundTo` with `block`.
[[nodiscard]] Result<Secret> openSecret(const Secret& key, std::string_view boundTo, std::size_t block,
                                        std::span<const std::byte> sealed);
[[nodiscard]] Result<std::vector<std::byte>> openBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                                       std::span<const std::byte> sealed);

[[nodiscard]] std::string base64Text(std::span<const std::byte> bytes);
/// Errors: ParseError.
[[nodiscard]] Result<std::vector<std::byte>> bytesOfBase64(std::string_view text);

/// Text to text, with kTextBlock.
[[nodiscard]] std::string sealText(const Secret& key, std::string_view boundTo, std::string_view text);
[[nodiscard]] Result<std::string> openText(const Secret& key, std::string_view boundTo, std::string_view sealed);

/// Keyed hash of `text` (BLAKE2b, 64 hexadecimal digits): only who has `key` makes it.
[[nodiscard]] std::string macText(const Secret& key, std::string_view text);

/// Subkey `number` of `key`, kKeyBytes bytes (crypto_kdf, context "tactpart").
[[nodiscard]] Secret subkey(const Secret& key, std::uint64_t number);

/// `digits` random hexadecimal digits (an even number).
[[nodiscard]] std::string randomHex(std::size_t digits);
/// Uniform in 0 .. bound-1.
[[nodiscard]] std::uint32_t randomBelow(std::uint32_t bound);

}  // namespace tacto
