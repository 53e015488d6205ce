// SessionSource.h - opens a session file for reading without changing a byte of it or of its journal.
//
//   no *-wal beside it        read as an immutable file; nothing is created
//   *-wal and *-shm           a running or killed writer: read only, with the journal's content
//   *-wal alone, or no access a private copy of both, recovered and removed afterwards
//
// Only SQLite opens the file itself (Database.h), since a writer of this process may hold it. A copy shows one moment;
// it is made again if another program writes meanwhile.
//
// Thread-safety: one owner; several sources may be open on one file.
#pragma once

#include <filesystem>
#include <memory>

#include "core/base/Result.h"
#include "core/session/Database.h"

namespace tacto {

class SessionSource {
public:
    /// Errors: NotFound; Unsupported if the file is not a session or comes from a newer program; ParseError if it is a
    /// damaged session; Io.
    [[nodiscard]] static Result<SessionSource> open(const std::filesystem::path& path);

    [[nodiscard]] const Database& database() const noexcept { return database_; }
    /// True if rows were in a journal: the writer was killed, or is still running.
    [[nodiscard]] bool hadJournal() const noexcept { return hadJournal_; }
    /// Whether the session's rows are sealed (SealedRow.h).
    [[nodiscard]] bool sealed() const noexcept { return sealed_; }

private:
    /// A folder that is removed with its last owner.
    struct PrivateFolder {
        explicit PrivateFolder(std::filesystem::path made);
        ~PrivateFolder();
        PrivateFolder(const PrivateFolder&) = delete;
        PrivateFolder& operator=(const PrivateFolder&) = delete;
        const std::filesystem::path path;
    };
    explicit SessionSource(Database database) noexcept : database_(std::move(database)) {}
    [[nodiscard]] static Result<SessionSource> openCopy(const std::filesystem::path& path);
    [[nodiscard]] static Result<SessionSource> openInPlace(const std::filesystem::path& path, const char* mode);

    std::shared_ptr<PrivateFolder> copy_;  // declared before database_, so that it is removed after the database closes
    Database database_;
    bool hadJournal_ = false;
    bool sealed_ = false;
};

}  // namespace tacto
