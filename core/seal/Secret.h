// Secret.h - bytes that must not leave the process: keys and passphrases. They lie in memory of their own between guard
// pages, locked against swapping where the system allows it, and are wiped when they go.
//
// Making the first one switches core dumps off for the process.
//
// Thread-safety: as a std::vector.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

class Secret {
public:
    Secret() noexcept = default;
    /// `size` zeros.
    explicit Secret(std::size_t size);
    /// A copy of `bytes`; wiping those is the caller's business.
    explicit Secret(std::span<const std::byte> bytes);
    ~Secret();
    Secret(Secret&& other) noexcept;
    Secret& operator=(Secret&& other) noexcept;
    Secret(const Secret&) = delete;
    Secret& operator=(const Secret&) = delete;

    [[nodiscard]] std::span<std::byte> bytes() noexcept { return {data_, size_}; }
    [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return {data_, size_}; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

    /// Random bytes.
    [[nodiscard]] static Secret random(std::size_t size);

private:
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

// Whether a file with a secret, and the folder that keys lie in, are this account's alone (hazard H11), as ssh asks it
// of a private key.

/// The open file `descriptor` belongs to this account or to root, and no one else may read or change it. `what` it is
/// stands in the sentence: "the key file". A terminal is not asked. Errors: NotFound, naming the mode or the owner.
[[nodiscard]] Result<void> isOwnFile(int descriptor, const std::filesystem::path& file, std::string_view what);
/// Checks the file by name; a link counts as what it names.
[[nodiscard]] Result<void> isOwnFile(const std::filesystem::path& file, std::string_view what);
/// The folder belongs to this account or to root, and no one else may put another file into it.
[[nodiscard]] Result<void> isOwnFolder(const std::filesystem::path& folder, std::string_view what);

}  // namespace tacto
