// SessionReport.h - makes the report's model from a session file alone: what a report needs must be in the session.
//
// Report items (SessionWriter::reportItem) are taken in the order written:
//   {"kind": "about", "title": "Signal separability", "purpose": "Can an oscilloscope ...",      once; later ones win
//    "parameters": [{"label": "Repeats per condition", "value": 25, "unit": ""}]}                 what the run used
//   {"kind": "figure", "caption": "Four conditions", "figure": {"type": "conditions", ...}}       Figure.h
//   {"kind": "table", "caption": "Pairs", "rows": [{"a": "smooth-low", "mahalanobis": 50.1}],
//    "columns": ["a", "b", "mahalanobis"]}                                                        columns optional
//   {"kind": "text", "text": "..."}
// Exposure: measurements named "exposure" with {"rows": [...]} as in Figure.h's type exposure. Of rows alike in name
// and source the worst is shown, and one that was not evaluated is worse than any number (hazard H9). Captures in
// figures are named by their seq. Verdict: the last verdict row; without one, a "stop" or "fault" event makes it
// *stopped*, and a session that was not closed is *stopped* whatever else it says. Events: those named fault, refused,
// stop, warning, adverse ... all but the quiet ones of a normal run.
//
// Thread-safety: pure function of the file.
#pragma once

#include <filesystem>

#include "app/report/ReportModel.h"

namespace tacto {

/// Errors: what SessionReader answers (NotFound, Unsupported for what is not a session, ParseError, Io);
/// InvalidArgument for exposure rows that break their contract. A report item that does so is shown as a sentence in
/// its place instead.
[[nodiscard]] Result<ReportModel> readSessionReport(const std::filesystem::path& sessionFile);

}  // namespace tacto
