#include "core/seal/SealedText.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <sodium.h>

namespace tacto {

static_assert(kKeyBytes == crypto_aead_xchacha20poly1305_ietf_KEYBYTES);
static_assert(kKeyBytes == crypto_kdf_KEYBYTES);

namespace {

constexpr std::size_t kNonceBytes = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t kTagBytes = crypto_aead_xchacha20poly1305_ietf_ABYTES;
constexpr auto kBase64 = sodium_base64_VARIANT_URLSAFE_NO_PADDING;

unsigned char* raw(std::byte* bytes) noexcept { return reinterpret_cast<unsigned char*>(bytes); }
const unsigned char* raw(const std::byte* bytes) noexcept { return reinterpret_cast<const unsigned char*>(bytes); }
const unsigned char* raw(std::string_view text) noexcept { return reinterpret_cast<const unsigned char*>(text.data()); }

/// Decrypts into `out`, of size sealed.size() - kNonceBytes - kTagBytes. Returns the size without padding.
Result<std::size_t> decrypt(const Secret& key, std::string_view boundTo, std::size_t block,
                            std::span<const std::byte> sealed, std::span<std::byte> out) {
    const auto refused = [] {
        return fail(ErrorCode::ParseError, "it does not open: it was altered or belongs to another key or place");
    };
    const auto* at = raw(sealed.data());
    if (crypto_aead_xchacha20poly1305_ietf_decrypt(raw(out.data()), nullptr, nullptr, at + kNonceBytes,
                                                   sealed.size() - kNonceBytes, raw(boundTo), boundTo.size(), at,
                                                   raw(key.bytes().data())) != 0)
        return refused();
    std::size_t size = 0;
    if (sodium_unpad(&size, raw(out.data()), out.size(), block) != 0) return refused();
    return size;
}

/// Returns the size of the output, padding included.
Result<std::size_t> paddedSize(const Secret& key, std::size_t block, std::span<const std::byte> sealed) {
    if (key.size() != kKeyBytes) return invalid("a key has {} bytes, not 32", key.size());
    if (sealed.size() < kNonceBytes + kTagBytes + block || (sealed.size() - kNonceBytes - kTagBytes) % block != 0)
        return fail(ErrorCode::ParseError, "it does not open: {} bytes are not a seal", sealed.size());
    return sealed.size() - kNonceBytes - kTagBytes;
}

}  // namespace

std::vector<std::byte> sealBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                 std::span<const std::span<const std::byte>> parts) {
    std::size_t size = 0;
    for (const auto part : parts) size += part.size();
    const std::size_t padded = (size / block + 1) * block;
    std::vector<std::byte> out(kNonceBytes + padded + kTagBytes);
    auto* text = out.data() + kNonceBytes;
    std::size_t filled = 0;
    for (const auto part : parts) {
        if (part.empty()) continue;
        std::memcpy(text + filled, part.data(), part.size());
        filled += part.size();
    }
    std::size_t paddedTo = 0;
    randombytes_buf(out.data(), kNonceBytes);
    if (key.size() != kKeyBytes || sodium_pad(&paddedTo, raw(text), size, block, padded) != 0 || paddedTo != padded)
        std::abort();  // the program passed an invalid key or block
    crypto_aead_xchacha20poly1305_ietf_encrypt(raw(text), nullptr, raw(text), padded, raw(boundTo), boundTo.size(),
                                               nullptr, raw(out.data()), raw(key.bytes().data()));
    return out;
}

Result<Secret> openSecret(const Secret& key, std::string_view boundTo, std::size_t block,
                          std::span<const std::byte> sealed) {
    const auto padded = paddedSize(key, block, sealed);
    if (!padded) return failure(padded);
    Secret out(*padded);
    const auto size = decrypt(key, boundTo, block, sealed, out.bytes());
    if (!size) return failure(size);
    return Secret(out.bytes().first(*size));
}

Result<std::vector<std::byte>> openBytes(const Secret& key, std::string_view boundTo, std::size_t block,
                                         std::span<const std::byte> sealed) {
    const auto padded = paddedSize(key, block, sealed);
    if (!padded) return failure(padded);
    std::vector<std::byte> out(*padded);
    const auto size = decrypt(key, boundTo, block, sealed, out);
    if (!size) return failure(size);
    out.resize(*size);
    return out;
}

std::string base64Text(std::span<const std::byte> bytes) {
    std::string text(sodium_base64_encoded_len(bytes.size(), kBase64), '\0');
    sodium_bin2base64(text.data(), text.size(), raw(bytes.data()), bytes.size(), kBase64);
    text.pop_back();  // removes the null byte
    return text;
}

Result<std::vector<std::byte>> bytesOfBase64(std::string_view text) {
    std::vector<std::byte> out(text.size() / 4 * 3 + 3);
    std::size_t size = 0;
    const char* end = nullptr;
    if (sodium_base642bin(raw(out.data()), out.size(), text.data(), text.size(), nullptr, &size, &end, kBase64) != 0 ||
        end != text.data() + text.size())
        return fail(ErrorCode::ParseError, "it does not open: it is not base64");
    out.resize(size);
    return out;
}

std::string sealText(const Secret& key, std::string_view boundTo, std::string_view text) {
    const std::span<const std::byte> parts[] = {std::as_bytes(std::span(text))};
    return base64Text(sealBytes(key, boundTo, kTextBlock, parts));
}

Result<std::string> openText(const Secret& key, std::string_view boundTo, std::string_view sealed) {
    const auto bytes = bytesOfBase64(sealed);
    if (!bytes) return failure(bytes);
    const auto opened = openBytes(key, boundTo, kTextBlock, *bytes);
    if (!opened) return failure(opened);
    return std::string(reinterpret_cast<const char*>(opened->data()), opened->size());
}

std::string macText(const Secret& key, std::string_view text) {
    std::array<unsigned char, crypto_generichash_BYTES> hash{};
    if (crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                           raw(key.bytes().data()), key.size()) != 0)
        std::abort();
    std::string digits(2 * hash.size() + 1, '\0');
    sodium_bin2hex(digits.data(), digits.size(), hash.data(), hash.size());
    digits.pop_back();  // removes the null byte
    return digits;
}

Secret subkey(const Secret& key, std::uint64_t number) {
    Secret out(kKeyBytes);
    if (key.size() != kKeyBytes || crypto_kdf_derive_from_key(raw(out.bytes().data()), kKeyBytes, number, "tactpart",
                                                              raw(key.bytes().data())) != 0)
        std::abort();
    return out;
}

std::string randomHex(std::size_t digits) {
    std::vector<unsigned char> bytes(digits / 2);
    randombytes_buf(bytes.data(), bytes.size());
    std::string text(digits + 1, '\0');
    sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
    text.resize(digits);
    return text;
}

std::uint32_t randomBelow(std::uint32_t bound) { return randombytes_uniform(bound); }

}  // namespace tacto
