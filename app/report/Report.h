// Report.h - writes a report as PDF (A4) or as one self-contained HTML page.
//
// An existing report is replaced only by a complete one; `path` never holds a partial file.
// Needs a QApplication (the offscreen platform will do) and the DejaVu fonts.
//
// Thread-safety: the GUI thread only (plots are widgets).
#pragma once

#include <QByteArray>
#include <QIODevice>
#include <QString>

#include "app/report/Fonts.h"
#include "app/report/ReportContent.h"
#include "app/report/ReportModel.h"

namespace tacto {

enum class ReportFormat { Pdf, Html };

/// Returns the format for the ending of `path`: .pdf, .html or .htm. Errors: InvalidArgument naming given and accepted.
[[nodiscard]] Result<ReportFormat> reportFormat(const QString& path);

/// Writes `model` to `path`.
/// Errors: Unsupported if a font is missing, naming the package; InvalidArgument for an ending other than .pdf, .html
/// or .htm; Io if the file cannot be written.
/// `installed` returns whether a font is installed; the default asks Qt.
[[nodiscard]] Result<void> writeReport(const ReportModel& model, const QString& path,
                                       const FontCheck& installed = fontInstalled);

/// Writes content that does not come from a session (StudyReport.h).
[[nodiscard]] Result<void> writeContent(const ReportContent& content, const QString& path,
                                        const FontCheck& installed = fontInstalled);

/// Returns one self-contained HTML page with styles and figures. Its text follows the reader's light or dark theme
/// (figures keep white paper). It prints well, and is well-formed XML, so that any tool can read it.
[[nodiscard]] QByteArray reportHtml(const ReportContent& content);
/// Writes A4 pages. A figure stays with its caption, a heading with the next block. A long table repeats its header; a
/// table too wide for the page continues below, with its first column repeated. Errors: Io if `device` fails.
[[nodiscard]] Result<void> writePdf(const ReportContent& content, QIODevice& device);

/// Verifies `sessionFile` once and writes its report to each of `paths`. Returns what is wrong with the session, or
/// nothing if it is intact: the report of an altered session is marked DAMAGED on every page (hazard H8).
/// Errors: as readSessionReport(); as writeReport(), after all other paths were written.
[[nodiscard]] Result<QStringList> writeSessionReport(const QString& sessionFile, const QStringList& paths);

}  // namespace tacto
