// ReportProgram.h - a separate program, tactoscope-report, draws the reports: it loads the libraries for windows and
// fonts, and without them all other commands start in half the time.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/Result.h"

namespace tacto::cli {

/// Replaces this program by tactoscope-report. Returns only if that cannot be started, with the exit code.
[[nodiscard]] int becomeReportProgram(char** argv);

/// Makes the report of a session as each of `outs`, and says on stderr if the session was altered. Stops if this
/// program ends. After an error some of them may be there. Errors: the report program's sentence, as Io; NotFound if
/// tactoscope-report cannot be started.
[[nodiscard]] Result<void> makeReports(const std::filesystem::path& session,
                                       const std::vector<std::filesystem::path>& outs);

}  // namespace tacto::cli
