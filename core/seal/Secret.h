// Secret.h - bytes that must not leave the process: keys and passphrases. They lie between guard pages in memory of
// their own, which is locked against swapping if the system allows this, and are wiped by the destructor.
//
// The first Secret switches core dumps off for the process.
//
// Thread-safety: as std::vector.
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
    /// Makes `size` zero bytes.
    explicit Secret(std::size_t size);
    /// Copies `bytes`; the caller must wipe the originals.
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

    /// Makes random bytes.
    [[nodiscard]] static Secret random(std::size_t size);

private:
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

// Checks that a file with a secret, or the folder with the keys, belongs to this account alone (hazard H11), as ssh
// checks a private key.

/// Checks that the open file `descriptor` belongs to this account or to root, and that nobody else may read or change
/// it. `what` names the file in the error ("the key file"). A terminal passes. Errors: NotFound, naming mode or owner.
[[nodiscard]] Result<void> isOwnFile(int descriptor, const std::filesystem::path& file, std::string_view what);
/// Checks a file by its name; follows links.
[[nodiscard]] Result<void> isOwnFile(const std::filesystem::path& file, std::string_view what);
/// Checks that the folder belongs to this account or to root, and that nobody else may put files into it.
[[nodiscard]] Result<void> isOwnFolder(const std::filesystem::path& folder, std::string_view what);

}  // namespace tacto
