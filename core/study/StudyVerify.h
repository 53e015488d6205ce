// StudyVerify.h - checks that a study is what was recorded: its ledger, settings and every session, without a key
// (`tactoscope-cli verify STUDY`).
//
// Thread-safety: any thread; reads files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/session/SessionVerify.h"

namespace tacto {

struct VerifiedFile {
    std::string file;  ///< 16 hexadecimal digits
    VerifyReport report;
};

struct StudyReport {
    SessionStatus status = SessionStatus::Damaged;  ///< Intact or Damaged
    std::vector<std::string> notes;
    std::vector<std::string> problems;  ///< of the study as a whole; each session's report has its own
    VerifyReport ledger;
    std::vector<VerifiedFile> sessions;
};

/// Errors: NotFound if there is no study; Unsupported for a study of a newer version; Io.
[[nodiscard]] Result<StudyReport> verifyStudy(const std::filesystem::path& folder);

}  // namespace tacto
