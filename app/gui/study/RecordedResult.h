// RecordedResult.h - what a session of a study came to, read again from its files with the study's key.
//
// Thread-safety: one caller of the study at a time.
#pragma once

#include "app/run/ProtocolRun.h"
#include "core/base/Result.h"
#include "core/study/Study.h"

namespace tacto::gui {

/// Verdict, reasons and results as the session recorded them, and whether it was simulated; the rest is empty.
/// Errors: kGateRefused for a session that is not complete; NotFound where its files hold no result; as Study::part().
[[nodiscard]] Result<RunResult> recordedResult(const Study& study, const StudySession& session);

}  // namespace tacto::gui
