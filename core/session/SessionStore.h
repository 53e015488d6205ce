// SessionStore.h - the rows of a session being written: numbers them, hashes them, keeps transactions. What
// SessionWriter is made of; it knows nothing of trials or captures.
//
// Thread-safety: none; SessionWriter holds its mutex around every call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/session/Chain.h"
#include "core/session/Chunk.h"
#include "core/session/Database.h"
#include "core/session/HashWorker.h"

namespace tacto {

class SessionStore {
public:
    /// Whether a commit must survive power loss, or only the end of the process.
    enum class Durability { PowerLoss, ProcessEnd };

    /// Makes the file with `about` (JSON) as row 1. See SessionWriter::create().
    [[nodiscard]] static Result<SessionStore> create(const std::filesystem::path& path, Instant at,
                                                     std::string_view about);

    /// What commit() promises for rows that were not added by addNow(). PowerLoss unless set.
    void setBackground(Durability durability) noexcept { background_ = durability; }

    /// Adds a row to the open transaction. The value is its seq.
    [[nodiscard]] Result<std::int64_t> add(std::string_view kind, Instant at, std::string_view name,
                                           std::string_view body);
    /// Adds a row and commits it, with all before it, so that it survives power loss.
    [[nodiscard]] Result<std::int64_t> addNow(std::string_view kind, Instant at, std::string_view name,
                                              std::string_view body);
    /// Adds samples with their row. `stamps` is empty when `head.line` is set. `head.crc` is filled in here.
    [[nodiscard]] Result<std::int64_t> addChunk(Instant at, ChunkHead head, std::span<const std::byte> stamps,
                                                std::span<const std::byte> data);
    [[nodiscard]] Result<std::int64_t> addCapture(Instant at, std::string_view body, const Digest& digest,
                                                  std::span<const std::byte> data);
    [[nodiscard]] Result<void> commit();
    /// Commits, and moves everything from the journal into the file.
    [[nodiscard]] Result<void> close();

    [[nodiscard]] const Digest& head() const noexcept { return head_; }
    [[nodiscard]] std::int64_t rows() const noexcept { return seq_; }

private:
    struct Statements {
        Statement entry;
        Statement chunk;
        Statement capture;
    };
    SessionStore(Database database, Statements statements) noexcept
        : database_(std::move(database)), statements_(std::move(statements)) {}
    /// Makes sure that a transaction of at least this durability is open.
    [[nodiscard]] Result<void> begin(Durability durability);
    [[nodiscard]] Result<std::int64_t> insert(const Entry& entry);
    [[nodiscard]] static Result<SessionStore> attach(Database database);

    std::optional<Database> database_;      // Nothing once closed
    std::optional<Statements> statements_;  // After database_: destroyed before it
    std::unique_ptr<HashWorker> hashing_ = std::make_unique<HashWorker>();
    Digest head_{};
    std::int64_t seq_ = 0;
    bool inTransaction_ = false;
    Durability background_ = Durability::PowerLoss;
    Durability current_ = Durability::PowerLoss;  // SQLite's setting; it cannot change inside a transaction
};

}  // namespace tacto
