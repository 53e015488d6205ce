// Passphrase.h - a passphrase that a person remembers, and the key that is derived from it (Argon2id, libsodium's
// crypto_pwhash).
//
// Thread-safety: values; keyFor() is a pure function that blocks for about a second.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/seal/Secret.h"

namespace tacto {

/// The cost of one guess. Only C++ code can choose it, never a file or an option.
class PassphraseCost {
public:
    /// 256 MiB of memory, three passes.
    [[nodiscard]] static PassphraseCost moderate() noexcept;
    /// The lowest cost that libsodium accepts. For tests.
    [[nodiscard]] static PassphraseCost least() noexcept;

    [[nodiscard]] unsigned long long passes() const noexcept { return passes_; }
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

private:
    PassphraseCost(unsigned long long passes, std::size_t bytes) noexcept : passes_(passes), bytes_(bytes) {}
    unsigned long long passes_;
    std::size_t bytes_;
};

class Passphrase {
public:
    static constexpr std::size_t kSaltBytes = 16;

    /// Errors: InvalidArgument for an empty text.
    [[nodiscard]] static Result<Passphrase> from(std::string_view text);
    [[nodiscard]] static Result<Passphrase> from(const Secret& text);
    /// Reads the first line of a file, without its line end. Errors: NotFound for a file that is missing, empty or
    /// accessible to others (isOwnFile()).
    [[nodiscard]] static Result<Passphrase> fromFile(const std::filesystem::path& file);

    /// Bits of guessing that the passphrase resists (zxcvbn; Wheeler 2016, USENIX Security): an attacker who knows
    /// words, keyboards, dates and repeats, and the words of `known`, needs about 2^bits guesses.
    [[nodiscard]] double strength_bits(std::string_view known = {}) const;
    /// Errors: InvalidArgument for a passphrase of less than kMinStrength_bits.
    [[nodiscard]] Result<void> checkStrength(std::string_view known = {}) const;
    static constexpr double kMinStrength_bits = 40;

    /// Returns a key of 32 bytes. Errors: Io if there is not enough memory.
    [[nodiscard]] Result<Secret> keyFor(std::span<const std::byte> salt, const PassphraseCost& cost) const;

private:
    explicit Passphrase(Secret text) : text_(std::move(text)) {}
    Secret text_;
};

}  // namespace tacto
