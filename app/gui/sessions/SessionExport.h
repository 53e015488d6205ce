// SessionExport.h - a session as files that other programs read: CSV per stream, trials, events, captures; and its
// sensor streams as a recording that can be replayed.
//
// Written into a new folder beside the target and renamed at the end: a cancelled or failed export leaves nothing, and
// none touches what was there before.
//
// Thread-safety: pure but for the files; runs beside the window.
#pragma once

#include <filesystem>

#include "app/gui/sessions/Background.h"

namespace tacto::gui {

/// Errors: as SessionReader; Io; Stopped when cancelled; InvalidArgument when `folder` is there already.
[[nodiscard]] Result<void> exportCsv(const std::filesystem::path& session, const std::filesystem::path& folder,
                                     const WorkPort& port);

/// recording.json and its CSV files. Errors: the same; NotFound for a session without sensor streams.
[[nodiscard]] Result<void> exportRecording(const std::filesystem::path& session, const std::filesystem::path& folder,
                                           const WorkPort& port);

}  // namespace tacto::gui
