// Durable.h - what makes a file that was written under another name survive power loss before it takes its place.
//
// Thread-safety: any thread; calls wait for the disk.
#pragma once

#include <filesystem>

#include "core/base/Result.h"

namespace tacto {

/// Waits until the content of a file would survive power loss. Errors: Io.
[[nodiscard]] Result<void> syncFile(const std::filesystem::path& file);
/// The same of the names in its folder. A folder that cannot be synced (some network file systems) is no reason to
/// refuse a session.
void syncFolderOf(const std::filesystem::path& file) noexcept;
/// Removes an SQLite file and those of its journals that exist.
void removeDraft(const std::filesystem::path& draft);

}  // namespace tacto
