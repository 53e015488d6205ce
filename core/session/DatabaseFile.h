// DatabaseFile.h - the bytes of an SQLite file, read through SQLite's own file layer.
//
// Another handle of this process on such a file would, when it is closed, drop every lock that this process holds on
// it, a running writer's among them (fcntl(2)); SQLite's layer keeps its handles open for as long as one of them is
// locked (sqlite.org/howtocorrupt.html section 2.2).
//
// Thread-safety: one owner; several may be open on one file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "core/base/Result.h"

namespace tacto {

class DatabaseFile {
public:
    /// For reading; nothing is locked. Errors: Io.
    [[nodiscard]] static Result<DatabaseFile> open(const std::filesystem::path& path);
    /// In bytes. Errors: Io.
    [[nodiscard]] Result<std::int64_t> size() const;
    /// Fills `bytes` from `at`. Errors: Io, also where the file ends before.
    [[nodiscard]] Result<void> read(std::int64_t at, std::span<std::byte> bytes) const;

private:
    struct State;
    explicit DatabaseFile(std::shared_ptr<State> state) : state_(std::move(state)) {}
    std::shared_ptr<State> state_;
};

/// Writes the content of the SQLite file `from` to `to`, which is new. Errors: Io.
[[nodiscard]] Result<void> copyDatabaseFile(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tacto
