#include "core/session/SessionStore.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include "core/session/Schema.h"

namespace tacto {

namespace {

constexpr const char* kInsertEntry =
    "INSERT INTO entries(seq, kind, t_ns, name, body, digest, prev, hash) VALUES(?,?,?,?,?,?,?,?)";
constexpr const char* kInsertChunk = "INSERT INTO chunks(seq, stream, idx, stamps, data) VALUES(?,?,?,?,?)";
constexpr const char* kInsertCapture = "INSERT INTO captures(seq, data) VALUES(?,?)";

std::span<const std::byte> bytesOf(const Digest& digest) noexcept { return std::as_bytes(std::span(digest)); }

/// Waits until the content of a file or folder would survive power loss. A folder that cannot be synced (some network
/// file systems) is no reason to refuse a session.
bool sync(const std::filesystem::path& path, int kind) {
    const int handle = ::open(path.c_str(), kind | O_RDONLY | O_CLOEXEC);
    if (handle < 0) return false;
    const bool done = ::fsync(handle) == 0;
    ::close(handle);
    return done;
}

/// Gives `from` the name `to` unless that name is taken; content first, then the name, survive power loss.
Result<void> publish(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (!sync(from, 0)) return fail(ErrorCode::Io, "{}", std::strerror(errno));
    // link() refuses an existing name, which rename() would silently replace. File systems without hard links (FAT)
    // answer EPERM or EOPNOTSUPP; there renameat2 does the same.
    const bool linked = ::link(from.c_str(), to.c_str()) == 0;
    if (!linked) {
        const bool noLinks = errno == EPERM || errno == EOPNOTSUPP;
        if (!noLinks || ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) != 0) {
            if (errno == EEXIST) return fail(ErrorCode::InvalidArgument, "it exists; a session is never overwritten");
            return fail(ErrorCode::Io, "{}", std::strerror(errno));
        }
    }
    std::error_code ignored;
    if (linked) std::filesystem::remove(from, ignored);
    const auto folder = to.has_parent_path() ? to.parent_path() : std::filesystem::path(".");
    static_cast<void>(sync(folder, O_DIRECTORY));
    return {};
}

std::filesystem::path withSuffix(std::filesystem::path path, const std::string& suffix) { return path += suffix; }

void removeDraft(const std::filesystem::path& draft) {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
        std::filesystem::remove(withSuffix(draft, suffix), ignored);
    }
}

}  // namespace

Result<SessionStore> SessionStore::attach(Database database) {
    auto entry = database.prepare(kInsertEntry);
    if (!entry) return failure(entry);
    auto chunk = database.prepare(kInsertChunk);
    if (!chunk) return failure(chunk);
    auto capture = database.prepare(kInsertCapture);
    if (!capture) return failure(capture);
    return SessionStore(std::move(database), Statements{std::move(*entry), std::move(*chunk), std::move(*capture)});
}

Result<SessionStore> SessionStore::create(const std::filesystem::path& path, Instant at, std::string_view about) {
    for (const char* suffix : {"", "-wal"}) {
        const auto taken = withSuffix(path, suffix);
        if (std::filesystem::exists(taken)) {
            return fail(ErrorCode::InvalidArgument, "{} exists; a session is never overwritten", taken.string());
        }
    }
    const auto because = [&](const auto& failed) {
        return fail(failed.error().code, "session {} cannot be made: {}", path.string(), failed.error().message);
    };
    // Made whole under another name first, so that a crash leaves either no session or a valid one.
    const auto draft = withSuffix(path, ".new-" + std::to_string(::getpid()));
    removeDraft(draft);
    auto made = [&]() -> Result<SessionStore> {
        auto database = Database::open(draft.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
        if (!database) return failure(database);
        if (auto fast = database->execute("PRAGMA synchronous=OFF"); !fast) return failure(fast);  // synced as a whole
        if (auto schema = createSchema(*database); !schema) return failure(schema);
        auto store = attach(std::move(*database));
        if (!store) return failure(store);
        if (auto row = store->add(kind::kAbout, at, "", about); !row) return failure(row);
        if (auto closed = store->close(); !closed) return failure(closed);
        if (auto published = publish(draft, path); !published) return failure(published);
        auto final = Database::open(path.string(), SQLITE_OPEN_READWRITE);
        if (!final) return failure(final);
        auto ready = final->execute("PRAGMA busy_timeout=2000; PRAGMA synchronous=FULL;");
        if (!ready) return failure(ready);
        auto opened = attach(std::move(*final));
        if (!opened) return failure(opened);
        opened->head_ = store->head_;
        opened->seq_ = store->seq_;
        return opened;
    }();
    removeDraft(draft);
    if (!made) return because(made);
    return made;
}

Result<void> SessionStore::begin(Durability durability) {
    if (inTransaction_ && (durability == current_ || current_ == Durability::PowerLoss)) return {};
    // A stronger demand ends the transaction; the next commit's sync covers the journal as a whole, this one included.
    if (auto done = commit(); !done) return done;
    if (durability != current_) {
        const bool full = durability == Durability::PowerLoss;
        auto set = database_->execute(full ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=NORMAL");
        if (!set) return set;
        current_ = durability;
    }
    auto begun = database_->execute("BEGIN");
    inTransaction_ = begun.has_value();
    return begun;
}

Result<std::int64_t> SessionStore::insert(const Entry& entry) {
    const Digest hash = chainHash(head_, entry);
    auto& row = statements_->entry;
    row.bind(1, entry.seq);
    row.bind(2, entry.kind);
    row.bind(3, entry.t_ns);
    row.bind(4, entry.name);
    row.bind(5, entry.body);
    if (entry.digest) {
        row.bind(6, bytesOf(*entry.digest));
    } else {
        row.bindNull(6);
    }
    row.bind(7, bytesOf(head_));
    row.bind(8, bytesOf(hash));
    if (auto ran = row.run(); !ran) return failure(ran);
    head_ = hash;
    seq_ = entry.seq;
    return seq_;
}

Result<std::int64_t> SessionStore::add(std::string_view kind, Instant at, std::string_view name,
                                       std::string_view body) {
    if (auto begun = begin(background_); !begun) return failure(begun);
    return insert({seq_ + 1, kind, at.count(), name, body, std::nullopt});
}

Result<std::int64_t> SessionStore::addNow(std::string_view kind, Instant at, std::string_view name,
                                          std::string_view body) {
    if (auto begun = begin(Durability::PowerLoss); !begun) return failure(begun);
    auto row = insert({seq_ + 1, kind, at.count(), name, body, std::nullopt});
    if (!row) return row;
    if (auto done = commit(); !done) return failure(done);
    return row;
}

Result<std::int64_t> SessionStore::addChunk(Instant at, ChunkHead head, std::span<const std::byte> stamps,
                                            std::span<const std::byte> data) {
    if (auto begun = begin(background_); !begun) return failure(begun);
    hashing_->start(stamps, data);
    auto& row = statements_->chunk;
    row.bind(1, seq_ + 1);
    row.bind(2, std::int64_t{head.stream});
    row.bind(3, head.index);
    if (head.line) {
        row.bindNull(4);
    } else {
        row.bind(4, stamps);
    }
    row.bind(5, data);
    auto ran = row.run();
    const auto checks = hashing_->wait();  // also when the insert failed: the worker still reads the bytes
    if (!ran) return failure(ran);
    head.crc = checks.crc;
    return insert({seq_ + 1, kind::kChunk, at.count(), "", toJsonText(head), checks.digest});
}

Result<std::int64_t> SessionStore::addCapture(Instant at, std::string_view body, const Digest& digest,
                                              std::span<const std::byte> data) {
    if (auto begun = begin(background_); !begun) return failure(begun);
    auto& row = statements_->capture;
    row.bind(1, seq_ + 1);
    row.bind(2, data);
    if (auto ran = row.run(); !ran) return failure(ran);
    return insert({seq_ + 1, kind::kCapture, at.count(), "", body, digest});
}

Result<void> SessionStore::commit() {
    if (!inTransaction_) return {};
    auto done = database_->execute("COMMIT");
    if (done) inTransaction_ = false;
    return done;
}

Result<void> SessionStore::close() {
    if (!database_) return {};
    auto done = commit();
    // A checkpoint that fails (disk full) loses nothing: the rows stay in the journal, where readers find them.
    if (done) static_cast<void>(database_->execute("PRAGMA wal_checkpoint(TRUNCATE)"));
    statements_.reset();
    database_.reset();
    return done;
}

}  // namespace tacto
