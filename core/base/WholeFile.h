// WholeFile.h - replaces a file by a complete new file or leaves it unchanged, even if the disk fills up (hazard H8).
//
// The content is written to a draft in the same folder. The draft has a short name, because the file's own name may
// already be as long as the file system allows.
//
// Thread-safety: any thread; if two write one file at once, it holds one complete content. A FileOut has one owner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// Returns a path in the folder of `path` that no other draft of this program has: ".tactoscope-", the process number
/// and a count. Creates nothing.
[[nodiscard]] std::filesystem::path draftBeside(const std::filesystem::path& path);

/// Removes the drafts that the process `owner`, which has ended, left in the folder of `path`.
void removeDraftsOf(int owner, const std::filesystem::path& path);

/// A file written from its beginning. Errors: Io; the message is only the system's reason ("No space left on device").
class FileOut {
public:
    [[nodiscard]] static Result<FileOut> create(const std::filesystem::path& path);
    ~FileOut();
    FileOut(FileOut&& other) noexcept;
    FileOut& operator=(FileOut&&) = delete;

    /// Writes the whole text, or returns an error.
    [[nodiscard]] Result<void> write(std::string_view text);
    [[nodiscard]] int descriptor() const noexcept { return file_; }

private:
    explicit FileOut(int file) noexcept : file_(file) {}
    int file_;
};

/// Lets `write` fill an existing empty draft, waits until the disk holds it, and then replaces `path` with it; the
/// permissions stay. If `path` is a link, the file behind the link is replaced. A pipe or device is its own draft: it
/// is written directly.
/// Errors: as `write`; Io with only the system's reason, so that the caller can add its own sentence.
[[nodiscard]] Result<void> replaceWholeFile(
    const std::filesystem::path& path, const std::function<Result<void>(const std::filesystem::path& draft)>& write);

/// Replaces a file by `content`.
[[nodiscard]] Result<void> writeWholeFile(const std::filesystem::path& path, std::string_view content);

/// Adds the file to an Io error: "out.csv could not be written: No space left on device". Other errors stay unchanged.
[[nodiscard]] Result<void> namedAs(const std::filesystem::path& path, Result<void> written);

// Finds the program that holds a lock on a file in the system's list of locks. Does not open the file: closing it would
// drop this process's own locks on the file (fcntl(2)).

enum class LockedBy {
    Any,
    Another  ///< any process except this one
};

/// Returns the process number. `kind`: "FLOCK" (flock(2)) or "POSIX" (fcntl(2)). Returns nothing if no process holds
/// such a lock or the list cannot be read.
[[nodiscard]] std::optional<std::int64_t> lockHolder(const std::filesystem::path& file, std::string_view kind,
                                                     LockedBy by = LockedBy::Any);

// Makes a file survive power loss before the file replaces another.

/// Waits until the file's content is safe from power loss. Errors: Io.
[[nodiscard]] Result<void> syncFile(const std::filesystem::path& file);
/// Makes the names in the file's folder safe from power loss. Ignores errors: some network file systems cannot sync
/// folders, and a session must still be possible.
void syncFolderOf(const std::filesystem::path& file) noexcept;
/// Removes a draft of an SQLite file, with its journals.
void removeDraft(const std::filesystem::path& draft);

}  // namespace tacto
