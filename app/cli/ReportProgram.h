// ReportProgram.h - reports are drawn by a program of their own, tactoscope-report: it loads the libraries of windows
// and fonts, and the commands that draw nothing start in half the time without them.
#pragma once

#include <filesystem>

#include "core/base/Result.h"

namespace tacto::cli {

/// `tactoscope-cli report ...` becomes tactoscope-report. Returns only where that cannot be started: the exit code.
[[nodiscard]] int becomeReportProgram(char** argv);

/// Has the report of a session written to `out`, and says on stderr if the session was altered. Ends with this program.
/// Errors: its sentence, as Io; NotFound where tactoscope-report cannot be started.
[[nodiscard]] Result<void> makeReport(const std::filesystem::path& session, const std::filesystem::path& out);

}  // namespace tacto::cli
