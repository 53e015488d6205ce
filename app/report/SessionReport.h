// SessionReport.h - makes the report's model from a session file alone: what a report needs must be in the session.
//
// Report items (SessionWriter::reportItem) are taken in the order written:
//   {"kind": "about", "title": "Signal separability", "purpose": "Can an oscilloscope ...",      once; later ones win
//    "parameters": [{"label": "Repeats per condition", "value": 25, "unit": ""}]}                 what the run used
//   {"kind": "figure", "caption": "Four conditions", "figure": {"type": "conditions", ...}}       Figure.h
//   {"kind": "table", "caption": "Pairs", "rows": [{"a": "smooth-low", "mahalanobis": 50.1}],
//    "columns": ["a", "b", "mahalanobis"]}                                                        columns optional
//   {"kind": "matrix", "caption": "Limits", "columns": ["100 ohm"], "rows": [...]}               ReportMatrix
//   {"kind": "text", "text": "..."}
//   {"kind": "notes", "operator": "...", "sample": "...", "reviewer": "...", "ambient": "..."}   as it was entered
//   {"kind": "certificate", "quantities": [...]}    of report.certificate(): the report is a calibration certificate
//   {"kind": "certificate details", "laboratory": "..."}                        as entered: CertificateDetails.h
//   {"kind": "basis", "results": {...}}        what the verdict rests on, of a run without one: ReportBasis.h
// Exposure: measurements named kExposureMeasurement, which the program alone writes, with {"rows": [...]} like those of
// a figure of type exposure, in a section of its own, titled as computed from approved trains. The worst of the rows
// alike in name, source and limit is shown; not evaluated is worse than any number (H9). A figure of a script that says
// no more than they is left out; another stands under the script's caption, as its other figures. Captures in figures
// are named by their seq. Verdict: the last verdict row; without one, a stop, a fault or a script's error makes it
// *stopped*; a session that was not closed is *stopped*, whatever its last verdict: close() it before its report is
// made. Events: faults, refusals, stops, remarks; not the quiet ones of a normal run.
//
// Thread-safety: pure function of the file.
#pragma once

#include <QJsonDocument>
#include <QJsonObject>
#include <filesystem>

#include "app/report/ReportModel.h"
#include "core/base/JsonText.h"

namespace tacto {

/// Verifies the file first; ReportModel::damage tells what is wrong with it, and no pass stands on it. Errors: what
/// SessionReader answers (NotFound, Unsupported for a file that is no session, ParseError, Io); InvalidArgument for
/// exposure rows that break their contract. A report item that does so is shown as a sentence in its place instead.
[[nodiscard]] Result<ReportModel> readSessionReport(const std::filesystem::path& sessionFile);

// JSON of a session file as Qt has it: figures, tables and reports are read with Qt's classes.

/// Empty for anything but an object. Bytes that JSON text cannot hold (a broken name) are replaced.
[[nodiscard]] inline QJsonObject qtObject(const nlohmann::json& json) {
    return QJsonDocument::fromJson(QByteArray::fromStdString(dumpJson(json))).object();
}

}  // namespace tacto
