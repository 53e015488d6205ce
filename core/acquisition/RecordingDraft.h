// RecordingDraft.h - drafts a recording.json for a table without one, from what the table itself shows.
//
// Thread-safety: reads a file; nothing is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct RecordingDraft {
    std::string json;                ///< has null for each value that the table does not show
    std::vector<std::string> open;   ///< what must still be filled in, one sentence each; empty: ready to be opened
    std::vector<std::string> taken;  ///< conclusions and omissions that the user should check
};

/// Drafts the description. Errors: as readTextFile(); ParseError for a file without a row of numbers.
[[nodiscard]] Result<RecordingDraft> draftRecording(const std::filesystem::path& table);

}  // namespace tacto
