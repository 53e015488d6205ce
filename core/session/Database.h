// Database.h - SQLite with owners and Results instead of pointers and codes. Used inside core/session only.
//
// Thread-safety: none; one caller at a time.
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace tacto
