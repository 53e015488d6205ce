// RecordingDraft.h - a recording.json for a table that has none, as far as the table shows what it holds.
//
// Thread-safety: reads a file; nothing is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct RecordingDraft {
    std::string json;                ///< null for what the table does not show
    std::vector<std::string> open;   ///< each of them: what is to be filled in; empty: it opens as it stands
    std::vector<std::string> taken;  ///< what was concluded or left out, and is to be looked at
};

/// Errors: as readTextFile(); ParseError for a file without a row of numbers.
[[nodiscard]] Result<RecordingDraft> draftRecording(const std::filesystem::path& table);

}  // namespace tacto
