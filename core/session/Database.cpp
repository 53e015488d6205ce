#include "core/session/Database.h"

#include <filesystem>
#include <sqlite3.h>
#include <system_error>

namespace tacto {

namespace {

tl::unexpected<Error> failFrom(sqlite3* database, int code) {
    const char* text = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code);
    switch (code & 0xff) {
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return fail(ErrorCode::ParseError, "{}", text);
        default:
            return fail(ErrorCode::Io, "{}", text);
    }
}

/// SQLite says of whatever keeps it from opening a file that it is unable to.
Error whyNotOpened(sqlite3* database, int code, const std::string& target) {
    constexpr int kSuffix = 8;  // length of the suffix of the journal's name, as SQLite counts it
    const auto bytes = std::filesystem::absolute(target).native().size();
    const auto most = static_cast<std::size_t>(sqlite3_vfs_find(nullptr)->mxPathname - kSuffix);
    auto error = failFrom(database, code).value();
    if (code != SQLITE_CANTOPEN) return error;
    if (bytes > most) {
        error.message =
            fmt::format("its path has {} bytes; at most {} are expected, as SQLite has room for", bytes, most);
    } else if (const int reason = database != nullptr ? sqlite3_system_errno(database) : 0; reason != 0) {
        error.message = std::generic_category().message(reason);
    }
    return error;
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
void Database::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

// A null pointer would bind NULL; an empty text or blob is a value.
void Statement::bind(int position, std::int64_t value) noexcept {
    sqlite3_bind_int64(statement_.get(), position, value);
}
void Statement::bind(int position, std::string_view text) noexcept {
    sqlite3_bind_text64(statement_.get(), position, text.empty() ? "" : text.data(), text.size(), SQLITE_STATIC,
                        SQLITE_UTF8);
}
void Statement::bind(int position, std::span<const std::byte> blob) noexcept {
    if (blob.empty()) {
        sqlite3_bind_zeroblob(statement_.get(), position, 0);
    } else {
        sqlite3_bind_blob64(statement_.get(), position, blob.data(), blob.size(), SQLITE_STATIC);
    }
}
void Statement::bindNull(int position) noexcept { sqlite3_bind_null(statement_.get(), position); }

Result<bool> Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    auto error = failFrom(sqlite3_db_handle(statement_.get()), code);
    sqlite3_reset(statement_.get());
    return error;
}

Result<void> Statement::run() {
    auto more = step();
    reset();
    if (!more) return failure(more);
    return {};
}

void Statement::reset() noexcept {
    sqlite3_reset(statement_.get());
    sqlite3_clear_bindings(statement_.get());
}

std::int64_t Statement::integer(int column) const noexcept { return sqlite3_column_int64(statement_.get(), column); }

std::string_view Statement::text(int column) const noexcept {
    const auto* data = sqlite3_column_blob(statement_.get(), column);
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return {static_cast<const char*>(data), data == nullptr ? 0 : static_cast<std::size_t>(size)};
}

std::span<const std::byte> Statement::blob(int column) const noexcept {
    const auto* data = sqlite3_column_blob(statement_.get(), column);
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return {static_cast<const std::byte*>(data), data == nullptr ? 0 : static_cast<std::size_t>(size)};
}

bool Statement::isNull(int column) const noexcept {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

Result<Database> Database::open(const std::string& target, int flags) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(target.c_str(), &opened, flags, nullptr);
    Database database(opened);  // SQLite gives an object to close even when it fails
    if (code != SQLITE_OK) return tl::unexpected(whyNotOpened(opened, code, target));
    sqlite3_extended_result_codes(opened, 1);
    return database;
}

Result<void> Database::execute(const std::string& sql) {
    const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return failFrom(database_.get(), code);
    return {};
}

bool Database::hasMoved() const noexcept {
    int moved = 0;
    return sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK && moved != 0;
}

Result<Statement> Database::prepare(std::string_view sql) const {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
    if (code != SQLITE_OK) return failFrom(database_.get(), code);
    return Statement(statement);
}

Result<std::int64_t> Database::number(std::string_view sql) const {
    auto statement = prepare(sql);
    if (!statement) return failure(statement);
    auto row = statement->step();
    if (!row) return failure(row);
    return *row ? statement->integer(0) : 0;
}

}  // namespace tacto
