// SessionReport.h - makes the model of a report from a session file alone: the session must hold all that it needs.
//
// Report items (SessionWriter::reportItem) are used in the order written:
//   {"kind": "about", "title": "Signal separability", "purpose": "Can an oscilloscope ...",      once; the last is used
//    "parameters": [{"label": "Repeats per condition", "value": 25, "unit": ""}]}                 parameters of the run
//   {"kind": "figure", "caption": "Four conditions", "figure": {"type": "conditions", ...}}       Figure.h
//   {"kind": "table", "caption": "Pairs", "rows": [{"a": "smooth-low", "mahalanobis": 50.1}],
//    "columns": ["a", "b", "mahalanobis"]}                                                        columns optional
//   {"kind": "matrix", "caption": "Limits", "columns": ["100 ohm"], "rows": [...]}               ReportMatrix
//   {"kind": "text", "text": "..."}
//   {"kind": "notes", "operator": "...", "sample": "...", "reviewer": "...", "ambient": "..."}   as entered
//   {"kind": "certificate", "quantities": [...]}    from report.certificate(): the report is a calibration certificate
//   {"kind": "certificate details", "laboratory": "..."}                        as entered: CertificateDetails.h
//   {"kind": "basis", "results": {...}}        basis of the results of a run without a verdict: ReportBasis.h
// Exposure: measurements named kExposureMeasurement, which only the program writes, with {"rows": [...]} like a figure
// of type exposure. They get their own section, titled as computed from approved trains. Of rows with the same name,
// source and limit the worst is shown; not evaluated is worse than any number (H9). A script's exposure figure is left
// out if it says no more than these rows; otherwise it is shown under the script's caption. Figures name captures by
// their seq. Verdict: the last verdict row. Without one, a stop, a fault or a script's error makes it *stopped*; so
// does a session that was not closed, whatever its last verdict: close() it first. Events: faults, refusals, stops and
// remarks, without the routine events of a normal run.
//
// Thread-safety: pure function of the file.
#pragma once

#include <QJsonDocument>
#include <QJsonObject>
#include <filesystem>

#include "app/report/ReportModel.h"
#include "core/base/JsonText.h"

namespace tacto {

/// Verifies the file first. ReportModel::damage says what is wrong with it; an altered file gives no pass. Errors:
/// those of SessionReader (NotFound, Unsupported for a file that is no session, ParseError, Io); InvalidArgument for
/// exposure rows that break their format. Any other report item that does so is replaced by a sentence.
[[nodiscard]] Result<ReportModel> readSessionReport(const std::filesystem::path& sessionFile);

// Converts JSON of a session file to Qt's classes, which figures, tables and reports use.

/// Returns an empty object for anything but an object. Bytes that JSON text cannot hold (a broken name) are replaced.
[[nodiscard]] inline QJsonObject qtObject(const nlohmann::json& json) {
    return QJsonDocument::fromJson(QByteArray::fromStdString(dumpJson(json))).object();
}

}  // namespace tacto
