// Report.h - writes a report as PDF (A4) or as one HTML page that needs no other file.
//
// An existing report is replaced only by a whole one; nothing half-written is ever left at `path`.
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

/// The format by the ending of `path`: .pdf, .html or .htm. Errors: InvalidArgument naming what was given and accepted.
[[nodiscard]] Result<ReportFormat> reportFormat(const QString& path);

/// Writes `model` to `path`.
/// Errors: Unsupported when a font is missing, naming the package; InvalidArgument for another ending than .pdf,
/// .html or .htm; Io when the file cannot be written.
/// `installed` says whether a font is there; the default asks Qt.
[[nodiscard]] Result<void> writeReport(const ReportModel& model, const QString& path,
                                       const FontCheck& installed = fontInstalled);

/// Writes a content that does not come from a session (StudyReport.h).
[[nodiscard]] Result<void> writeContent(const ReportContent& content, const QString& path,
                                        const FontCheck& installed = fontInstalled);

/// One HTML page that needs no other file: styles and figures are inside it. It follows the reader's light or dark
/// theme for text (figures keep paper white), prints well, and is well-formed XML, so that any tool can read it.
[[nodiscard]] QByteArray reportHtml(const ReportContent& content);
/// A4 pages. A figure stays with its caption, a heading with what follows; a long table repeats its header, and one too
/// wide for the page continues below with its first column repeated. Errors: Io when `device` refuses.
[[nodiscard]] Result<void> writePdf(const ReportContent& content, QIODevice& device);

/// Verifies `sessionFile` and writes its report to `path`. The value is what is wrong with the session: the report of
/// one that was altered is marked DAMAGED on every page (hazard H8). Empty when it is intact.
/// Errors: as writeReport(), and as readSessionReport().
[[nodiscard]] Result<QStringList> writeSessionReport(const QString& sessionFile, const QString& path);

}  // namespace tacto
