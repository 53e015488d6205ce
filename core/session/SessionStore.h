// SessionStore.h - the rows of a session being written: numbers them, hashes them, keeps transactions. What
// SessionWriter is made of; it knows nothing of trials or captures.
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

    /// Makes the file with `about` (JSON) as row 1. See SessionWriter::create().
    [[nodiscard]] static Result<SessionStore> create(const std::filesystem::path& path, Instant at,
                                                     std::string_view about,
                                                     std::shared_ptr<const RowSeal> seal = nullptr);

    /// Opens a session that no writer holds, to add annotations after its last row. Errors: ParseError for one that is
    /// damaged; Io.
    [[nodiscard]] static Result<SessionStore> annotate(const std::filesystem::path& path);
    /// Opens a file that no writer holds, to add rows after its last one (Ledger.h). Errors: as annotate().
    [[nodiscard]] static Result<SessionStore> continued(const std::filesystem::path& path);

    /// The durability that commit() promises for rows that were not added by addNow(). PowerLoss unless set.
    void setBackground(Durability durability) noexcept { background_ = durability; }

    /// Adds a row to the open transaction. The value is its seq.
    [[nodiscard]] Result<std::int64_t> add(std::string_view kind, Instant at, std::string_view name,
                                           std::string_view body);
    /// Adds a row and commits it, with all before it, so that it survives power loss.
    [[nodiscard]] Result<std::int64_t> addNow(std::string_view kind, Instant at, std::string_view name,
                                              std::string_view body);
    /// Hashes samples and queues them with their row; the next commit of either kind writes them. `block` is taken and
    /// an empty one with room given back. `head` is complete but for line and crc.
    void queueChunk(Instant at, ChunkHead head, SampleBlock& block);
    [[nodiscard]] Result<std::int64_t> addCapture(Instant at, std::string_view body, const Digest& digest,
                                                  std::span<const std::byte> data);
    [[nodiscard]] Result<void> commit();
    /// Writes the queued chunks and commits on another thread, while the caller hashes the next ones; what it meets is
    /// reported by the next call here.
    [[nodiscard]] Result<void> commitInBackground();
    /// The result of a commit started before, if it has ended. Never waits.
    [[nodiscard]] Result<void> collect();
    /// Commits, and moves everything from the journal into the file.
    [[nodiscard]] Result<void> close();
    /// Closes after an error: uncommitted rows are dropped. A later row without the failed one would be a hole.
    void abandon() noexcept;

    [[nodiscard]] const Digest& head() const noexcept { return head_; }
    [[nodiscard]] std::int64_t rows() const noexcept { return seq_; }

private:
    struct Statements {
        Statement entry;
        Statement chunk;
        Statement capture;
    };
    /// A row that has its place in the chain.
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
        ChunkHead head;
        SampleBlock block;
        std::vector<std::byte> sealed;  // the block as it is sealed, where rows are sealed
        std::string body;               // the text that row.body refers to
        Row row;
    };

    SessionStore(Database database, Statements statements) noexcept
        : database_(std::move(database)), statements_(std::move(statements)) {}
    [[nodiscard]] static Result<SessionStore> attach(Database database);
    /// Gives a row its number and hash.
    [[nodiscard]] Row chain(std::string_view kind, Instant at, std::string_view name, std::string_view body,
                            const std::optional<Digest>& digest);
    /// Seals the row, where rows are sealed, and writes it.
    [[nodiscard]] Result<Row> put(std::string_view kind, Instant at, std::string_view name, std::string_view body,
                                  const std::optional<Digest>& digest = std::nullopt);
    [[nodiscard]] Result<void> write(const Row& row);
    [[nodiscard]] Result<void> write(const QueuedChunk& chunk);
    [[nodiscard]] Result<void> writeAll(const std::vector<QueuedChunk>& chunks);
    /// Makes sure that a transaction of at least this durability is open and holds all that was queued.
    [[nodiscard]] Result<void> begin(Durability durability);
    /// Opens without a look at the queue.
    [[nodiscard]] Result<void> open(Durability durability);
    /// Waits for a commit started before, and returns how it went.
    [[nodiscard]] Result<void> settle();
    void recycle(std::vector<QueuedChunk>& chunks);

    std::optional<Database> database_;      // nothing once it is closed
    std::optional<Statements> statements_;  // stands after database_, so that it is destroyed before it
    std::shared_ptr<const RowSeal> seal_;   // Null: rows are stored as they are
    Digest head_{};
    std::int64_t seq_ = 0;
    std::vector<QueuedChunk> queued_;   // in the chain, but not yet written
    std::vector<QueuedChunk> written_;  // Being written by committing_
    std::vector<SampleBlock> spare_;    // Empty, with room: keeps a steady state from allocating
    bool inTransaction_ = false;
    Durability background_ = Durability::PowerLoss;
    Durability current_ = Durability::PowerLoss;  // SQLite's setting; it cannot change inside a transaction
    std::unique_ptr<CommitThread> committing_;    // Made by the first background commit; destroyed first
};

}  // namespace tacto
