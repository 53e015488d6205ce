// OpenRecording.h - opens recordings of every format: tables of text, EDF, BDF, XDF.
//
// Thread-safety: functions that read files.
#pragma once

#include "core/acquisition/Recording.h"
#include "core/acquisition/RecordingDraft.h"

namespace tacto {

/// Endings of files that name their own channels, in small letters.
inline constexpr const char* kSignalEndings[] = {".edf", ".bdf", ".xdf", ".xdfz", ".xdf.gz"};
[[nodiscard]] bool isSignalName(const std::filesystem::path& path);

/// Reads an EDF, BDF or XDF file, the latter also packed by gzip, by its ending or by how it begins; nothing for
/// others.
[[nodiscard]] Result<std::optional<SignalFile>> readSignals(const std::filesystem::path& path);

/// As Recording::open() and draftRecording(), of these formats too.
[[nodiscard]] Result<Recording> openRecording(const std::filesystem::path& path);
[[nodiscard]] Result<RecordingDraft> draftAnyRecording(const std::filesystem::path& path);

}  // namespace tacto
