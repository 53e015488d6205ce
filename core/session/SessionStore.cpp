#include "core/session/SessionStore.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include "core/base/WholeFile.h"
#include "core/session/Schema.h"
#include "core/session/SealedRow.h"

namespace tacto {

namespace {

constexpr const char* kInsertEntry =
    "INSERT INTO entries(seq, kind, t_ns, name, body, digest, prev, hash) VALUES(?,?,?,?,?,?,?,?)";
constexpr const char* kInsertChunk = "INSERT INTO chunks(seq, stream, idx, stamps, data) VALUES(?,?,?,?,?)";
constexpr const char* kInsertCapture = "INSERT INTO captures(seq, data) VALUES(?,?)";

std::span<const std::byte> bytesOf(const Digest& digest) noexcept { return std::as_bytes(std::span(digest)); }

/// Gives `from` the name `to` if that name is free. The content becomes safe from power loss first, then the name.
Result<void> publish(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (auto kept = syncFile(from); !kept) return kept;
    // link() refuses an existing name; rename() would silently replace the file. File systems without hard links (FAT)
    // answer EPERM or EOPNOTSUPP; renameat2 then does the same.
    const bool linked = ::link(from.c_str(), to.c_str()) == 0;
    if (!linked) {
        const bool noLinks = errno == EPERM || errno == EOPNOTSUPP;
        if (!noLinks || ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) != 0) {
            if (errno == EEXIST) return invalid("it exists; a session is never overwritten");
            return fail(ErrorCode::Io, "{}", std::strerror(errno));
        }
    }
    std::error_code ignored;
    if (linked) std::filesystem::remove(from, ignored);
    syncFolderOf(to);
    return {};
}

std::filesystem::path withSuffix(std::filesystem::path path, const std::string& suffix) { return path += suffix; }

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

Result<SessionStore> SessionStore::create(const std::filesystem::path& path, Instant at, std::string_view about,
                                          int version, std::shared_ptr<const RowSeal> seal) {
    const auto because = [&](const auto& failed) {
        return fail(failed.error().code, "session {} cannot be made: {}", path.string(), failed.error().message);
    };
    for (const char* suffix : {"", "-wal"}) {
        const auto taken = withSuffix(path, suffix);
        std::error_code error;  // set, for example, by a name that is too long
        if (std::filesystem::exists(taken, error)) {
            return invalid("{} exists; a session is never overwritten", taken.string());
        }
        if (error) return because(Result<void>(fail(ErrorCode::Io, "{}", error.message())));
    }
    // Made under another name first, so that a crash leaves either no session or a valid session.
    const auto draft = draftBeside(path);
    removeDraft(draft);
    auto made = [&]() -> Result<SessionStore> {
        auto database = Database::open(draft.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
        if (!database) return failure(database);
        if (auto fast = database->execute("PRAGMA synchronous=OFF"); !fast) return failure(fast);  // synced at the end
        if (auto schema = createSchema(*database, version); !schema) return failure(schema);
        auto store = attach(std::move(*database));
        if (!store) return failure(store);
        store->seal_ = seal;
        if (auto row = store->add(kind::kAbout, at, "", about); !row) return failure(row);
        if (auto written = store->commit(); !written) return failure(written);
        // Otherwise the rows would stay in the draft's journal, which is not published.
        if (auto whole = store->database_->execute("PRAGMA wal_checkpoint(TRUNCATE)"); !whole) return failure(whole);
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
        opened->seal_ = seal;
        return opened;
    }();
    removeDraft(draft);
    if (!made) return because(made);
    return made;
}

Result<SessionStore> SessionStore::annotate(const std::filesystem::path& path) {
    auto store = continued(path);
    if (!store) return store;
    const auto version = store->database_->number("PRAGMA user_version");
    if (!version) return failure(version);
    if (*version >= kAnnotatedVersion) return store;
    auto set = store->database_->execute(fmt::format("PRAGMA user_version={}", kAnnotatedVersion));
    if (!set) return failure(set);
    return store;
}

Result<SessionStore> SessionStore::continued(const std::filesystem::path& path) {
    auto database = Database::open(path.string(), SQLITE_OPEN_READWRITE);
    if (!database) return failure(database);
    if (auto set = database->execute("PRAGMA synchronous=FULL"); !set) return failure(set);
    Digest head;
    std::int64_t seq = 0;
    {
        auto last = database->prepare("SELECT seq, hash FROM entries ORDER BY seq DESC LIMIT 1");
        if (!last) return failure(last);
        const auto row = last->step();
        if (!row) return failure(row);
        const auto hash = *row ? last->blob(1) : std::span<const std::byte>();
        if (hash.size() != head.size()) return fail(ErrorCode::ParseError, "its last row has no hash");
        std::memcpy(head.data(), hash.data(), head.size());
        seq = last->integer(0);
    }
    auto store = attach(std::move(*database));
    if (!store) return failure(store);
    store->head_ = head;
    store->seq_ = seq;
    return store;
}

Result<void> SessionStore::settle() {
    if (!committing_) return {};
    auto done = committing_->wait();
    recycle(written_);
    return done;
}

Result<void> SessionStore::collect() {
    if (!committing_ || committing_->busy()) return {};
    return settle();
}

void SessionStore::recycle(std::vector<QueuedChunk>& chunks) {
    for (auto& chunk : chunks) {
        chunk.block.clear();
        spare_.push_back(std::move(chunk.block));
    }
    chunks.clear();
}

Result<void> SessionStore::open(Durability durability) {
    if (inTransaction_ && (durability == current_ || current_ == Durability::PowerLoss)) return {};
    // Stronger durability ends the transaction; the next commit syncs the whole journal, with this transaction in it.
    if (inTransaction_) {
        if (auto done = database_->execute("COMMIT"); !done) return done;
        inTransaction_ = false;
    }
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

Result<void> SessionStore::begin(Durability durability) {
    if (auto settled = settle(); !settled) return settled;
    if (auto opened = open(durability); !opened) return opened;
    auto written = writeAll(queued_);
    recycle(queued_);
    return written;
}

SessionStore::Row SessionStore::chain(std::string_view kind, Instant at, std::string_view name, std::string_view body,
                                      const std::optional<Digest>& digest) {
    const Digest hash = chainHash(head_, {seq_ + 1, kind, at.count(), name, body, digest});
    Row row{seq_ + 1, at, kind, name, body, digest, head_, hash};
    head_ = hash;
    ++seq_;
    return row;
}

Result<SessionStore::Row> SessionStore::put(std::string_view kind, Instant at, std::string_view name,
                                            std::string_view body, const std::optional<Digest>& digest) {
    OutsideRow outside;
    if (seal_ != nullptr) {
        outside = sealedRow(*seal_, seq_ + 1, kind, at, name, body);
        at = outside.at;
        name = outside.name;
        body = outside.body;
    }
    auto row = chain(kind, at, name, body, digest);
    if (auto written = write(row); !written) return failure(written);
    row.name = row.body = {};  // both point into `outside`, which ends here
    return row;
}

Result<void> SessionStore::write(const Row& row) {
    auto& insert = statements_->entry;
    insert.bind(1, row.seq);
    insert.bind(2, row.kind);
    insert.bind(3, std::int64_t{row.at.count()});
    insert.bind(4, row.name);
    insert.bind(5, row.body);
    if (row.digest) {
        insert.bind(6, bytesOf(*row.digest));
    } else {
        insert.bindNull(6);
    }
    insert.bind(7, bytesOf(row.previous));
    insert.bind(8, bytesOf(row.hash));
    return insert.run();
}

Result<void> SessionStore::write(QueuedChunk& chunk) {
    auto& head = chunk.head;
    const auto& block = chunk.block;
    head.line = lineThrough(block.t_s);
    auto parts = recordedBytes(block, !head.line);
    head.crc = crc32(parts);
    OutsideRow outside;
    std::vector<std::byte> sealed;
    if (seal_ != nullptr) {
        sealed = sealedBulk(*seal_, seq_ + 1, kind::kChunk, parts);
        parts = {{{}, sealed}};
        outside = sealedRow(*seal_, seq_ + 1, kind::kChunk, chunk.at, "", toJsonText(head));
    } else {
        const auto stream = static_cast<std::size_t>(head.stream) - 1;
        if (stream >= packers_.size()) packers_.resize(stream + 1);
        if (const auto packed = packers_[stream].pack(block, !head.line); !packed.empty()) {
            head.packing = kPackedAsSteps;
            parts = {{{}, packed}};
        }
        outside = {chunk.at, "", toJsonText(head)};
    }
    const auto row = chain(kind::kChunk, outside.at, "", outside.body, bulkDigest(parts));
    auto& insert = statements_->chunk;
    insert.bind(1, row.seq);
    insert.bind(2, std::int64_t{head.stream});
    insert.bind(3, head.index);
    if (parts[0].empty()) {
        insert.bindNull(4);
    } else {
        insert.bind(4, parts[0]);
    }
    insert.bind(5, parts[1]);
    if (auto ran = insert.run(); !ran) return ran;
    return write(row);
}

Result<void> SessionStore::writeAll(std::vector<QueuedChunk>& chunks) {
    for (auto& chunk : chunks) {
        if (auto written = write(chunk); !written) return written;
    }
    return {};
}

Result<std::int64_t> SessionStore::add(std::string_view kind, Instant at, std::string_view name,
                                       std::string_view body) {
    if (auto begun = begin(background_); !begun) return failure(begun);
    const auto row = put(kind, at, name, body);
    if (!row) return failure(row);
    return row->seq;
}

Result<std::int64_t> SessionStore::addNow(std::string_view kind, Instant at, std::string_view name,
                                          std::string_view body) {
    if (auto begun = begin(Durability::PowerLoss); !begun) return failure(begun);
    const auto row = put(kind, at, name, body);
    if (!row) return failure(row);
    if (auto done = commit(); !done) return failure(done);
    return row->seq;
}

void SessionStore::queueChunk(Instant at, ChunkHead head, SampleBlock& block) {
    queued_.push_back({at, std::move(head), std::move(block)});
    block = {};
    if (!spare_.empty()) {
        block = std::move(spare_.back());
        spare_.pop_back();
    }
}

Result<std::int64_t> SessionStore::addCapture(Instant at, std::string_view body, const Digest& digest,
                                              std::span<const std::byte> data) {
    if (auto begun = begin(background_); !begun) return failure(begun);
    std::vector<std::byte> sealed;
    auto stored = digest;
    if (seal_ != nullptr) {
        const std::span<const std::byte> parts[] = {data};
        sealed = sealedBulk(*seal_, seq_ + 1, kind::kCapture, parts);
        const std::span<const std::byte> outside[] = {sealed};
        stored = bulkDigest(outside);
        data = sealed;
    }
    auto& insert = statements_->capture;
    insert.bind(1, seq_ + 1);
    insert.bind(2, data);
    if (auto ran = insert.run(); !ran) return failure(ran);
    const auto row = put(kind::kCapture, at, "", body, stored);
    if (!row) return failure(row);
    return row->seq;
}

Result<void> SessionStore::commit() {
    if (auto settled = settle(); !settled) return settled;
    if (!queued_.empty()) {
        if (auto begun = begin(background_); !begun) return begun;
    }
    if (!inTransaction_) return {};
    auto done = database_->execute("COMMIT");
    if (done) inTransaction_ = false;
    return done;
}

Result<void> SessionStore::commitInBackground() {
    if (auto settled = settle(); !settled) return settled;
    if (!inTransaction_ && queued_.empty()) return {};
    if (auto opened = open(background_); !opened) return opened;
    inTransaction_ = false;
    std::swap(queued_, written_);
    if (!committing_) committing_ = std::make_unique<CommitThread>();
    committing_->start([this] {
        auto written = writeAll(written_);
        if (written) written = database_->execute("COMMIT");
        if (written && database_->hasMoved()) written = fail(ErrorCode::Io, "its file was moved or removed");
        return written;
    });
    return {};
}

Result<void> SessionStore::close() {
    if (!database_) return {};
    auto done = commit();
    // A failed checkpoint (disk full) loses nothing: the rows stay in the journal, and readers find them there.
    if (done) static_cast<void>(database_->execute("PRAGMA wal_checkpoint(TRUNCATE)"));
    statements_.reset();
    database_.reset();
    return done;
}

void SessionStore::abandon() noexcept {
    if (!database_) return;
    static_cast<void>(settle());
    queued_.clear();
    statements_.reset();
    database_.reset();  // closing the database rolls back an open transaction
}

}  // namespace tacto
