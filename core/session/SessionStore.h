// SessionStore.h - writes the rows of a session: numbers and hashes them, and manages transactions. A part of
// SessionWriter; it knows nothing of trials or captures.
//
// Thread-safety: none; SessionWriter holds its mutex around every call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/packing/PackedColumns.h"
#include "core/session/Chunk.h"
#include "core/session/CommitThread.h"
#include "core/session/Database.h"
#include "core/session/Digest.h"
#include "core/session/RowSeal.h"

namespace tacto {

class SessionStore {
public:
    /// Whether a commit must survive power loss, or only the end of the process.
    enum class Durability { PowerLoss, ProcessEnd };

    /// Creates the file in the format `version` with `about` (JSON) as row 1. See SessionWriter::create().
    [[nodiscard]] static Result<SessionStore> create(const std::filesystem::path& path, Instant at,
                                                     std::string_view about, int version,
                                                     std::shared_ptr<const RowSeal> seal = nullptr);

    /// Opens a session that no writer holds, to add annotations after its last row. Errors: ParseError for a damaged
    /// session; Io.
    [[nodiscard]] static Result<SessionStore> annotate(const std::filesystem::path& path);
    /// Opens a file that no writer holds, to add rows after its last row (Ledger.h). Errors: as annotate().
    [[nodiscard]] static Result<SessionStore> continued(const std::filesystem::path& path);

    /// Sets the durability of commit() for rows that addNow() did not add. The default is PowerLoss.
    void setBackground(Durability durability) noexcept { background_ = durability; }

    /// Adds a row to the open transaction. Returns the row's seq.
    [[nodiscard]] Result<std::int64_t> add(std::string_view kind, Instant at, std::string_view name,
                                           std::string_view body);
    /// Adds a row and commits it with all rows before it, so that they survive power loss.
    [[nodiscard]] Result<std::int64_t> addNow(std::string_view kind, Instant at, std::string_view name,
                                              std::string_view body);
    /// Queues samples; the next row or commit of either kind packs, hashes and writes them first. `block` is moved from
    /// and replaced by an empty block with reserved room. `head` must be complete except for line, crc and packing.
    void queueChunk(Instant at, ChunkHead head, SampleBlock& block);
    [[nodiscard]] Result<std::int64_t> addCapture(Instant at, std::string_view body, const Digest& digest,
                                                  std::span<const std::byte> data);
    [[nodiscard]] Result<void> commit();
    /// Packs, hashes, writes and commits the queued chunks on another thread. The next call here reports the errors of
    /// that thread.
    [[nodiscard]] Result<void> commitInBackground();
    /// Returns the result of an earlier background commit, if it has ended. Never waits.
    [[nodiscard]] Result<void> collect();
    /// Waits for an earlier background commit and returns its result.
    [[nodiscard]] Result<void> settle();
    /// Commits, then moves all rows from the journal to the file.
    [[nodiscard]] Result<void> close();
    /// Closes after an error and drops uncommitted rows: a later row without the failed row would leave a gap.
    void abandon() noexcept;

    // Of the last row written; call settle() first.
    [[nodiscard]] const Digest& head() const noexcept { return head_; }
    [[nodiscard]] std::int64_t rows() const noexcept { return seq_; }

private:
    struct Statements {
        Statement entry;
        Statement chunk;
        Statement capture;
    };
    /// A row with its place in the chain.
    struct Row {
        std::int64_t seq = 0;
        Instant at{0};
        std::string_view kind;
        std::string_view name;
        std::string_view body;
        std::optional<Digest> digest;
        Digest previous{};
        Digest hash{};
    };
    struct QueuedChunk {
        Instant at{0};
        ChunkHead head;
        SampleBlock block;
    };

    SessionStore(Database database, Statements statements) noexcept
        : database_(std::move(database)), statements_(std::move(statements)) {}
    [[nodiscard]] static Result<SessionStore> attach(Database database);
    /// Gives a row its number and its hash.
    [[nodiscard]] Row chain(std::string_view kind, Instant at, std::string_view name, std::string_view body,
                            const std::optional<Digest>& digest);
    /// Seals the row, if rows are sealed, and writes it.
    [[nodiscard]] Result<Row> put(std::string_view kind, Instant at, std::string_view name, std::string_view body,
                                  const std::optional<Digest>& digest = std::nullopt);
    [[nodiscard]] Result<void> write(const Row& row);
    [[nodiscard]] Result<void> write(QueuedChunk& chunk);
    [[nodiscard]] Result<void> writeAll(std::vector<QueuedChunk>& chunks);
    /// Makes sure that a transaction of at least this durability is open and contains all queued chunks.
    [[nodiscard]] Result<void> begin(Durability durability);
    /// Opens a transaction without writing the queue.
    [[nodiscard]] Result<void> open(Durability durability);
    void recycle(std::vector<QueuedChunk>& chunks);

    std::optional<Database> database_;      // empty once closed
    std::optional<Statements> statements_;  // declared after database_, to be destroyed before it
    std::shared_ptr<const RowSeal> seal_;   // null: rows are not sealed
    // While committing_ runs, it alone uses these, and the database.
    Digest head_{};
    std::int64_t seq_ = 0;
    std::vector<ColumnPacker> packers_;  // one for each stream
    std::vector<QueuedChunk> written_;
    std::vector<QueuedChunk> queued_;  // not yet written
    std::vector<SampleBlock> spare_;   // empty blocks with room, so that steady recording does not allocate
    bool inTransaction_ = false;
    Durability background_ = Durability::PowerLoss;
    Durability current_ = Durability::PowerLoss;  // SQLite's setting, which cannot change inside a transaction
    std::unique_ptr<CommitThread> committing_;    // made by the first background commit; destroyed first
};

}  // namespace tacto
