// Database.h - SQLite with owning objects and Results in place of pointers and codes. Used only inside core/session.
//
// Thread-safety: none; one caller at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace tacto {

/// A prepared statement; its Database must outlive it. Bound texts and blobs must stay valid until step() returns.
class Statement {
public:
    void bind(int position, std::int64_t value) noexcept;
    void bind(int position, std::string_view text) noexcept;
    void bind(int position, std::span<const std::byte> blob) noexcept;
    void bindNull(int position) noexcept;

    /// Returns true if there is a row, false after the last. Errors: Io; ParseError if the file is damaged; Stopped.
    [[nodiscard]] Result<bool> step();
    /// Runs a statement that returns no rows, and resets it for the next run.
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
    /// Runs one or more statements without parameters.
    [[nodiscard]] Result<void> execute(const std::string& sql);
    [[nodiscard]] Result<Statement> prepare(std::string_view sql) const;
    /// While the result lives, `stopped` is asked every few milliseconds of a long statement, which ends with the error
    /// Stopped once it says yes. Where SQLite asks nothing for 0.1 s another thread asks. Nothing is asked if it is
    /// empty.
    [[nodiscard]] std::shared_ptr<void> interruptedBy(const std::function<bool()>& stopped) const;
    /// Whether the file was moved or removed since it was opened, so that its name no longer leads to it.
    [[nodiscard]] bool hasMoved() const noexcept;
    /// Returns the first column of the first row of `sql` as an integer; 0 if there are no rows.
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
// If this process opened such a file in another way, closing that handle would drop all locks of the process on the
// file, also a running writer's locks (fcntl(2)). SQLite's layer keeps its handles open as long as any of them holds a
// lock (sqlite.org/howtocorrupt.html section 2.2).

class DatabaseFile {
public:
    /// Opens the file for reading; locks nothing. Errors: Io.
    [[nodiscard]] static Result<DatabaseFile> open(const std::filesystem::path& path);
    /// Returns the size in bytes. Errors: Io.
    [[nodiscard]] Result<std::int64_t> size() const;
    /// Fills `bytes` with the bytes of the file from position `at`. Errors: Io, also if the file ends too early.
    [[nodiscard]] Result<void> read(std::int64_t at, std::span<std::byte> bytes) const;

private:
    struct State;
    explicit DatabaseFile(std::shared_ptr<State> state) : state_(std::move(state)) {}
    std::shared_ptr<State> state_;
};

/// Copies the SQLite file `from` to the new file `to`. Errors: Io.
[[nodiscard]] Result<void> copyDatabaseFile(const std::filesystem::path& from, const std::filesystem::path& to);

// Looks for damage in the journal (*-wal) that a killed session left behind.
//
// SQLite reads a journal up to the first frame with a wrong checksum and silently ignores the rest: a crash leaves such
// a journal, with an unfinished last transaction. But every acknowledged commit was synced before the next one began,
// so a crash cannot leave frames of a further transaction behind the bad frame: they are lost evidence.

struct WalFindings {
    std::uint64_t readableFrames = 0;
    bool headerDamaged = false;     ///< frames exist, but the header that describes them is not valid
    std::uint64_t lostCommits = 0;  ///< commits behind the first bad frame, without the unfinished last transaction
};

/// Errors: Io.
[[nodiscard]] Result<WalFindings> scanWal(const std::filesystem::path& wal);

}  // namespace tacto
