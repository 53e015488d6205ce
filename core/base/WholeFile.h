// WholeFile.h - replaces a file by a whole new one or leaves it unchanged, even on a disk that fills up (hazard H8).
//
// The content goes into a draft in the same folder, with a short name whatever the file is called: a name may have as
// many bytes as the file system allows.
//
// Thread-safety: any thread; two that write one file at once both leave a whole one. A FileOut has one owner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// A path in the folder of `path` that no other draft of this program has: ".tactoscope-", its process's number and a
/// count. Nothing is made.
[[nodiscard]] std::filesystem::path draftBeside(const std::filesystem::path& path);

/// Removes the drafts in the folder of `path` that the process `owner`, which has ended, left there.
void removeDraftsOf(int owner, const std::filesystem::path& path);

/// A file that is written from its beginning. Errors: Io with the system's reason alone ("No space left on device").
class FileOut {
public:
    [[nodiscard]] static Result<FileOut> create(const std::filesystem::path& path);
    ~FileOut();
    FileOut(FileOut&& other) noexcept;
    FileOut& operator=(FileOut&&) = delete;

    /// The whole text or an error.
    [[nodiscard]] Result<void> write(std::string_view text);
    [[nodiscard]] int descriptor() const noexcept { return file_; }

private:
    explicit FileOut(int file) noexcept : file_(file) {}
    int file_;
};

/// Lets `write` make the draft that it is given, which exists and is empty; then the disk holds it, and it takes the
/// place of `path`, with its permissions. A link stays, and the file that it names is replaced. A pipe or a device is
/// written to directly: it is the draft itself.
/// Errors: those of `write`, and Io with the system's reason alone, for the caller's own sentence.
[[nodiscard]] Result<void> replaceWholeFile(
    const std::filesystem::path& path, const std::function<Result<void>(const std::filesystem::path& draft)>& write);

/// Writes a content that is at hand.
[[nodiscard]] Result<void> writeWholeFile(const std::filesystem::path& path, std::string_view content);

/// The sentence about a file that was asked for: "out.csv could not be written: No space left on device". Errors that
/// are not about the file (other than Io) stay as they are.
[[nodiscard]] Result<void> namedAs(const std::filesystem::path& path, Result<void> written);

// Which program holds a lock on a file, as the system lists it. Opens nothing: a handle that this
// process closed would drop its own locks on the file (fcntl(2)).

enum class LockedBy {
    Any,
    Another  ///< a process other than this one
};

/// The process. `kind`: "FLOCK" (flock(2)) or "POSIX" (fcntl(2)). Nothing where none holds one, and where that cannot
/// be seen.
[[nodiscard]] std::optional<std::int64_t> lockHolder(const std::filesystem::path& file, std::string_view kind,
                                                     LockedBy by = LockedBy::Any);

// Makes a file that was written under another name survive power loss before it takes its place.

/// Waits until the content of a file would survive power loss. Errors: Io.
[[nodiscard]] Result<void> syncFile(const std::filesystem::path& file);
/// Makes the names in its folder durable. A folder that cannot be synced (some network file systems) is no reason to
/// refuse a session.
void syncFolderOf(const std::filesystem::path& file) noexcept;
/// Removes an SQLite file and its journals.
void removeDraft(const std::filesystem::path& draft);

}  // namespace tacto
