// HtmlReport.h - the report as one HTML page that needs no other file: styles and figures are inside it. Follows the
// reader's light or dark theme for text (figures keep paper white), and prints well.
//
// Well-formed XML, so that any tool can read it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QByteArray>

#include "app/report/ReportContent.h"

namespace tacto {

[[nodiscard]] QByteArray reportHtml(const ReportContent& content);

}  // namespace tacto
