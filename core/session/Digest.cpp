#include "core/session/Digest.h"

#include <fmt/format.h>
#include <iterator>
#include <libdeflate.h>
#include <sodium.h>
#include <string>

namespace tacto {

static_assert(std::tuple_size_v<Digest> == crypto_hash_sha256_BYTES);

namespace {

const unsigned char* bytesOf(std::string_view text) noexcept {
    return reinterpret_cast<const unsigned char*>(text.data());
}

/// Lets libsodium choose its fastest implementations once; without this call the hash functions work, only slower.
void startSodium() noexcept {
    static const int started = sodium_init();
    static_cast<void>(started);
}

}  // namespace

Digest sha256(std::string_view bytes) {
    Digest digest;
    crypto_hash_sha256(digest.data(), bytesOf(bytes), bytes.size());
    return digest;
}

std::string sha256Hex(std::string_view bytes) { return hexText(sha256(bytes)); }

Digest bulkDigest(std::span<const std::span<const std::byte>> parts) {
    startSodium();
    crypto_generichash_state state;
    crypto_generichash_init(&state, nullptr, 0, std::tuple_size_v<Digest>);
    for (const auto part : parts) {
        crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(part.data()), part.size());
    }
    Digest digest;
    crypto_generichash_final(&state, digest.data(), digest.size());
    return digest;
}

std::uint32_t crc32(std::span<const std::span<const std::byte>> parts) {
    std::uint32_t crc = 0;
    for (const auto part : parts) {
        if (part.empty()) continue;  // a null pointer means "start from the beginning"
        crc = libdeflate_crc32(crc, part.data(), part.size());
    }
    return crc;
}

std::string hexText(const Digest& digest) {
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    text.reserve(digest.size() * 2);
    for (const unsigned char byte : digest) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

Digest chainHash(const Digest& previous, const Entry& entry) {
    std::string bytes(previous.begin(), previous.end());
    fmt::format_to(std::back_inserter(bytes), "{}\n{}\n{}\n{}:", entry.seq, entry.t_ns, entry.kind, entry.name.size());
    bytes.append(entry.name);
    fmt::format_to(std::back_inserter(bytes), "\n{}:", entry.body.size());
    bytes.append(entry.body);
    fmt::format_to(std::back_inserter(bytes), "\n{}\n", entry.digest ? hexText(*entry.digest) : "-");
    return sha256(bytes);
}

}  // namespace tacto
