// Database.h - SQLite with owners and Results instead of pointers and codes. Used inside core/session only.
//
// Thread-safety: none; one caller at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace tacto {

/// A prepared statement. Outlived by its Database. Bound texts and blobs must live until step() returned.
class Statement {
public:
    void bind(int position, std::int64_t value) noexcept;
    void bind(int position, std::string_view text) noexcept;
    void bind(int position, std::span<const std::byte> blob) noexcept;
    void bindNull(int position) noexcept;

    /// True when there is a row, false when done. Errors: Io; ParseError when the file is damaged.
    [[nodiscard]] Result<bool> step();
    /// Runs a statement without rows and makes it ready for the next run.
    [[nodiscard]] Result<void> run();
    void reset() noexcept;

    [[nodiscard]] std::int64_t integer(int column) const noexcept;
    /// Valid until the next step() or reset().
    [[nodiscard]] std::string_view text(int column) const noexcept;
    [[nodiscard]] std::span<const std::byte> blob(int column) const noexcept;
    [[nodiscard]] bool isNull(int column) const noexcept;

private:
    friend class Database;
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const noexcept;
    };
    explicit Statement(sqlite3_stmt* statement) noexcept : statement_(statement) {}
    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Database {
public:
    /// `target` is a path or, with `flags` containing SQLITE_OPEN_URI, a file: URI.
    /// Errors: Io, or ParseError when the content is not SQLite.
    [[nodiscard]] static Result<Database> open(const std::string& target, int flags);
    /// One or more statements without parameters.
    [[nodiscard]] Result<void> execute(const std::string& sql);
    [[nodiscard]] Result<Statement> prepare(std::string_view sql) const;
    /// True when the file no longer has the name by which it was opened: it was moved or removed.
    [[nodiscard]] bool hasMoved() const noexcept;
    /// The first column of the first row of `sql`, as an integer; 0 without rows.
    [[nodiscard]] Result<std::int64_t> number(std::string_view sql) const;

private:
    struct Close {
        void operator()(sqlite3* database) const noexcept;
    };
    explicit Database(sqlite3* database) noexcept : database_(database) {}
    std::unique_ptr<sqlite3, Close> database_;
};

// The bytes of an SQLite file, read through SQLite's own file layer.
//
// Another handle of this process on such a file would, when it is closed, drop every lock that this process holds on
// it, a running writer's among them (fcntl(2)); SQLite's layer keeps its handles open for as long as one of them is
// locked (sqlite.org/howtocorrupt.html section 2.2).

class DatabaseFile {
public:
    /// Opens it for reading; nothing is locked. Errors: Io.
    [[nodiscard]] static Result<DatabaseFile> open(const std::filesystem::path& path);
    /// The size in bytes. Errors: Io.
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

// Looks for damage in the journal (*-wal) that a killed session left behind.
//
// SQLite reads a journal up to the first frame whose checksum is wrong and silently ignores the rest, since a crash
// leaves exactly that: an unfinished last transaction. But every acknowledged commit was synced before the next one
// began, so frames of a further transaction beyond the bad one cannot come from a crash. They are lost evidence.

struct WalFindings {
    std::uint64_t readableFrames = 0;
    bool headerDamaged = false;     ///< there are frames, but the header that tells how to read them is not valid
    std::uint64_t lostCommits = 0;  ///< commits behind the first bad frame, without the unfinished last transaction
};

/// Errors: Io.
[[nodiscard]] Result<WalFindings> scanWal(const std::filesystem::path& wal);

}  // namespace tacto
