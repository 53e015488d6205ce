// SessionExport.h - exports a session for other programs: CSV files of streams, trials, events and captures; or its
// sensor streams as a recording that can be replayed.
//
// Files are written into a new folder next to the target, and this folder gets its name at the end: a cancelled or
// failed export leaves nothing behind, and no export changes existing files.
//
// Thread-safety: no shared state except the files; runs on another thread.
#pragma once

#include <filesystem>

#include "app/gui/sessions/Background.h"

namespace tacto::gui {

/// Errors: as SessionReader; Io; Stopped if cancelled; InvalidArgument if `folder` already exists.
[[nodiscard]] Result<void> exportCsv(const std::filesystem::path& session, const std::filesystem::path& folder,
                                     const WorkPort& port);

/// Writes recording.json and its CSV files. Errors: the same; NotFound for a session without sensor streams.
[[nodiscard]] Result<void> exportRecording(const std::filesystem::path& session, const std::filesystem::path& folder,
                                           const WorkPort& port);

}  // namespace tacto::gui
