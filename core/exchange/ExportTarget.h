// ExportTarget.h - a file or folder that appears under its name complete, or not at all.
//
// It is written under a private name beside the target (".NAME.XXXXXX", made exclusively), synced, and then renamed
// without replacing anything. Nothing but the private name is ever removed.
//
// Thread-safety: one owner.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/Result.h"

namespace tacto {

class ExportTarget {
public:
    enum class Kind { File, Folder };

    /// Makes the private file (empty) or folder. Errors: InvalidArgument if `path` exists, also as a link to nothing,
    /// or names no file; Io with the system's reason.
    [[nodiscard]] static Result<ExportTarget> begin(const std::filesystem::path& path, Kind kind);
    ExportTarget(ExportTarget&& other) noexcept;
    ExportTarget& operator=(ExportTarget&&) = delete;
    ~ExportTarget();  ///< removes the private file or folder, unless it was published

    /// What is to be filled: the private file, which may be opened again, or the private folder.
    [[nodiscard]] const std::filesystem::path& draft() const noexcept { return draft_; }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Waits until the disk holds everything, then gives it its name. Errors: InvalidArgument if the target exists
    /// meanwhile; Io.
    [[nodiscard]] Result<void> publish();
    /// Returns the error with the path that was asked for in place of the private one.
    [[nodiscard]] Error named(Error error) const;

private:
    ExportTarget(std::filesystem::path path, std::filesystem::path draft, Kind kind)
        : path_(std::move(path)), draft_(std::move(draft)), kind_(kind) {}
    [[nodiscard]] Error isThere() const;

    std::filesystem::path path_;
    std::filesystem::path draft_;  // empty once published
    Kind kind_;
};

}  // namespace tacto
