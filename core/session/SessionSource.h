// SessionSource.h - opens a session file for reading without changing a byte of it or of its journal.
//
//   no *-wal beside it        read as an immutable file; nothing is created
//   *-wal and *-shm           a running or killed writer: read only, with the journal's content
//   *-wal alone, or no access a private copy of both, recovered and removed afterwards
//
// The file itself is opened with nothing but SQLite (Database.h), since a writer of this process may hold it. A
// copy is of one moment: it is made again where another program wrote meanwhile.
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
    /// Errors: NotFound; Unsupported when it is not a session or was made by a newer program; ParseError when it is one
    /// and is damaged; Io.
    [[nodiscard]] static Result<SessionSource> open(const std::filesystem::path& path);

    [[nodiscard]] const Database& database() const noexcept { return database_; }
    /// True when rows lay in a journal: the writer was killed, or still runs.
    [[nodiscard]] bool hadJournal() const noexcept { return hadJournal_; }
    /// True when its rows are sealed (SealedRow.h).
    [[nodiscard]] bool sealed() const noexcept { return sealed_; }

private:
    /// A folder that goes with its last owner.
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

    std::shared_ptr<PrivateFolder> copy_;  // stands before database_, so that it is removed after that is closed
    Database database_;
    bool hadJournal_ = false;
    bool sealed_ = false;
};

}  // namespace tacto
