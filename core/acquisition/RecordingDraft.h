// RecordingDraft.h - drafts a recording.json for a table without one, from what the table itself shows.
//
// Thread-safety: reads a file; nothing is written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/acquisition/SignalFile.h"
#include "core/base/Result.h"

namespace tacto {

struct RecordingDraft {
    std::string json;                ///< has null for each value that the table does not show
    std::vector<std::string> open;   ///< what must still be filled in, one sentence each; empty: ready to be opened
    std::vector<std::string> taken;  ///< conclusions and omissions that the user should check
};

/// Drafts the description; what a file holds that `reader` knows stands in `taken`. Errors: as readTextFile(), and the
/// reader's; ParseError for a file without a row of numbers.
[[nodiscard]] Result<RecordingDraft> draftRecording(const std::filesystem::path& table,
                                                    const SignalReader& reader = {});

}  // namespace tacto
