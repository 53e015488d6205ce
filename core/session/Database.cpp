#include "core/session/Database.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <span>
#include <sqlite3.h>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/WholeFile.h"

namespace tacto {

namespace {

tl::unexpected<Error> failFrom(sqlite3* database, int code) {
    const char* text = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code);
    switch (code & 0xff) {
        case SQLITE_CORRUPT:
        case SQLITE_NOTADB:
            return fail(ErrorCode::ParseError, "{}", text);
        case SQLITE_INTERRUPT:
            return fail(ErrorCode::Stopped, "cancelled");
        default:
            return fail(ErrorCode::Io, "{}", text);
    }
}

/// SQLite reports only that it cannot open a file; this looks for the reason.
Error whyNotOpened(sqlite3* database, int code, const std::string& target) {
    constexpr int kSuffix = 8;  // length of the suffix of the journal's name, by SQLite's count
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

// A null pointer would bind NULL; an empty text or blob must be bound as a value.
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
    Database database(opened);  // SQLite returns an object to close even if opening fails
    if (code != SQLITE_OK) return tl::unexpected(whyNotOpened(opened, code, target));
    sqlite3_extended_result_codes(opened, 1);
    return database;
}

Result<void> Database::execute(const std::string& sql) {
    const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return failFrom(database_.get(), code);
    return {};
}

namespace {

/// Asks whether to stop: SQLite's thread every few instructions of its machine, and where one of them takes long, as
/// that which checks all pages of a table, a thread of its own.
class Asking {
public:
    Asking(sqlite3* database, const std::function<bool()>& stopped)
        : database_(database), stopped_(stopped), watch_([this](const std::stop_token& ended) { watch(ended); }) {
        constexpr int kInstructions = 1000;
        sqlite3_progress_handler(database_, kInstructions, &Asking::ask, this);
    }
    ~Asking() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;

private:
    static int ask(void* self) {
        auto& asking = *static_cast<Asking*>(self);
        asking.asked_ = true;
        return asking.stopped_() ? 1 : 0;
    }
    void watch(const std::stop_token& ended) {
        constexpr std::chrono::milliseconds kSilence{100};
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any never;
        while (!never.wait_for(lock, ended, kSilence, [&] { return ended.stop_requested(); }))
            if (!asked_.exchange(false) && stopped_()) sqlite3_interrupt(database_);
    }

    sqlite3* const database_;
    const std::function<bool()>& stopped_;
    std::atomic<bool> asked_ = true;
    std::jthread watch_;  // declared last: ends first
};

}  // namespace

std::shared_ptr<void> Database::interruptedBy(const std::function<bool()>& stopped) const {
    return stopped ? std::make_shared<Asking>(database_.get(), stopped) : nullptr;
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

namespace {
constexpr std::size_t kBlock = 1 << 20;
}

struct DatabaseFile::State {
    explicit State(const std::filesystem::path& path)
        : name(sqlite3_create_filename(std::filesystem::absolute(path).c_str(), "", "", 0, nullptr)) {}
    ~State() {
        if (file() != nullptr && file()->pMethods != nullptr) static_cast<void>(file()->pMethods->xClose(file()));
        sqlite3_free_filename(name);  // SQLite's file layer needs the name until here
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    [[nodiscard]] sqlite3_file* file() noexcept { return reinterpret_cast<sqlite3_file*>(room.data()); }

    sqlite3_filename name;
    std::vector<std::max_align_t> room;  // memory for one file of SQLite's file layer
};

Result<DatabaseFile> DatabaseFile::open(const std::filesystem::path& path) {
    sqlite3_initialize();
    auto* layer = sqlite3_vfs_find(nullptr);
    auto state = std::make_shared<State>(path);
    if (layer == nullptr || state->name == nullptr) return fail(ErrorCode::Io, "{} cannot be opened", path.string());
    state->room.resize((static_cast<std::size_t>(layer->szOsFile) + sizeof(std::max_align_t) - 1) /
                       sizeof(std::max_align_t));
    const int code =
        layer->xOpen(layer, state->name, state->file(), SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB, nullptr);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{} cannot be opened: {}", path.string(), sqlite3_errstr(code));
    return DatabaseFile(std::move(state));
}

Result<std::int64_t> DatabaseFile::size() const {
    sqlite3_int64 bytes = 0;
    const int code = state_->file()->pMethods->xFileSize(state_->file(), &bytes);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{}: {}", state_->name, sqlite3_errstr(code));
    return bytes;
}

Result<void> DatabaseFile::read(std::int64_t at, std::span<std::byte> bytes) const {
    const int code = state_->file()->pMethods->xRead(state_->file(), bytes.data(), static_cast<int>(bytes.size()), at);
    if (code != SQLITE_OK) return fail(ErrorCode::Io, "{}: {}", state_->name, sqlite3_errstr(code));
    return {};
}

Result<void> copyDatabaseFile(const std::filesystem::path& from, const std::filesystem::path& to) {
    const auto file = DatabaseFile::open(from);
    if (!file) return failure(file);
    const auto size = file->size();
    if (!size) return failure(size);
    auto out = FileOut::create(to);
    if (!out) return failure(out);
    std::vector<std::byte> block(kBlock);
    for (std::int64_t at = 0; at < *size;) {
        const auto next = std::span(block).first(std::min(kBlock, static_cast<std::size_t>(*size - at)));
        if (auto done = file->read(at, next); !done) return done;
        if (auto done = out->write({reinterpret_cast<const char*>(next.data()), next.size()}); !done) return done;
        at += static_cast<std::int64_t>(next.size());
    }
    return {};
}

namespace {

constexpr std::size_t kHeader = 32;
constexpr std::size_t kFrameHeader = 24;
constexpr std::uint32_t kMagic = 0x377f0682;  // its last bit is set if checksums read big-endian words

std::uint32_t word(std::span<const char> bytes, std::size_t at, bool big) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[at + (big ? i : 3 - i)]);
        value = value << 8 | byte;
    }
    return value;
}

struct Checksum {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    void add(std::span<const char> bytes, bool big) {
        for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
            first += word(bytes, i, big) + second;
            second += word(bytes, i + 4, big) + first;
        }
    }
    [[nodiscard]] bool matches(std::span<const char> bytes, std::size_t at) const {
        return word(bytes, at, true) == first && word(bytes, at + 4, true) == second;
    }
};

}  // namespace

Result<WalFindings> scanWal(const std::filesystem::path& wal) {
    WalFindings findings;
    std::ifstream file(wal, std::ios::binary);
    if (!file) return fail(ErrorCode::Io, "{} cannot be read", wal.string());
    std::vector<char> header(kHeader);
    if (!file.read(header.data(), kHeader)) return findings;
    const auto magic = word(header, 0, true);
    const std::size_t pageSize = word(header, 8, true);
    if ((magic & ~1U) != kMagic || pageSize < 512 || pageSize > 65'536) {
        findings.headerDamaged = file.peek() != std::char_traits<char>::eof();
        return findings;
    }
    const bool big = (magic & 1U) != 0;
    Checksum sum;
    sum.add(std::span(header).first(24), big);
    bool readable = sum.matches(header, 24);
    findings.headerDamaged = !readable && file.peek() != std::char_traits<char>::eof();

    std::vector<char> frame(kFrameHeader + pageSize);
    bool commitWaits = false;  // a commit behind the bad frame is lost only if a further transaction follows
    while (file.read(frame.data(), static_cast<std::streamsize>(frame.size()))) {
        const bool current = std::equal(frame.begin() + 8, frame.begin() + 16, header.begin() + 16);
        if (!current) {  // left from before the journal last restarted, or altered
            readable = false;
            continue;
        }
        if (readable) {
            sum.add(std::span<const char>(frame).first(8), big);
            sum.add(std::span<const char>(frame).subspan(kFrameHeader), big);
            readable = sum.matches(frame, 16);
            if (readable) ++findings.readableFrames;
        }
        if (!readable) {
            if (commitWaits) ++findings.lostCommits;
            commitWaits = word(frame, 4, true) != 0;
        }
    }
    return findings;
}

}  // namespace tacto
