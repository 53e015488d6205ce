// Passphrase.h - what a person keeps in their head, and the key that is made of it (Argon2id, libsodium's
// crypto_pwhash).
//
// Thread-safety: values; keyFor() is a pure function that blocks for about a second.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/base/Result.h"
#include "core/seal/Secret.h"

namespace tacto {

/// The cost of one guess. Only a caller in C++ chooses it: no file and no option does.
class PassphraseCost {
public:
    /// 256 MiB, three passes.
    [[nodiscard]] static PassphraseCost moderate() noexcept;
    /// The least that libsodium accepts. For tests.
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

    /// Errors: InvalidArgument for an empty one.
    [[nodiscard]] static Result<Passphrase> from(std::string_view text);
    [[nodiscard]] static Result<Passphrase> from(const Secret& text);
    /// The first line of a file, without its end. Errors: NotFound for a file that is not there, holds nothing
    /// or is not its owner's alone (isOwnFile()).
    [[nodiscard]] static Result<Passphrase> fromFile(const std::filesystem::path& file);

    /// 32 bytes. Errors: Io without the memory.
    [[nodiscard]] Result<Secret> keyFor(std::span<const std::byte> salt, const PassphraseCost& cost) const;

private:
    explicit Passphrase(Secret text) : text_(std::move(text)) {}
    Secret text_;
};

}  // namespace tacto
