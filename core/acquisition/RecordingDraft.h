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
    std::string json;                ///< null for a value that the table does not show
    std::vector<std::string> open;   ///< what is still to be filled in, one sentence each; empty: it opens as it stands
    std::vector<std::string> taken;  ///< conclusions and omissions that should be looked at
};

/// Errors: as readTextFile(); ParseError for a file without a row of numbers.
[[nodiscard]] Result<RecordingDraft> draftRecording(const std::filesystem::path& table);

}  // namespace tacto
