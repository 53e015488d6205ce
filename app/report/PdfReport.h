// PdfReport.h - sets a report's blocks on A4 pages. A figure stays with its caption, a heading with what follows; a
// long table repeats its header, and one too wide for the page continues below with its first column repeated.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QIODevice>

#include "app/report/ReportContent.h"

namespace tacto {

/// Errors: Io when `device` refuses.
[[nodiscard]] Result<void> writePdf(const ReportContent& content, QIODevice& device);

}  // namespace tacto
