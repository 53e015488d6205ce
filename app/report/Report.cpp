#include "app/report/Report.h"

#include <QBuffer>
#include <QFileInfo>

#include "core/base/WholeFile.h"

namespace tacto {

Result<ReportFormat> reportFormat(const QString& path) {
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending == "pdf") return ReportFormat::Pdf;
    if (ending == "html" || ending == "htm") return ReportFormat::Html;
    return fail(ErrorCode::InvalidArgument, "The report's file is \"{}\"; its name must end in .pdf, .html or .htm.",
                path.toStdString());
}

Result<void> writeReport(const ReportModel& model, const QString& path, const FontCheck& installed) {
    // Checked before anything is drawn.
    if (const auto format = reportFormat(path); !format) return failure(format);
    if (auto fonts = requireFonts(installed); !fonts) return fonts;
    return writeContent(contentOf(model), path, installed);
}

Result<void> writeContent(const ReportContent& content, const QString& path, const FontCheck& installed) {
    const auto format = reportFormat(path);
    if (!format) return failure(format);
    if (auto fonts = requireFonts(installed); !fonts) return fonts;
    QByteArray bytes;
    if (*format == ReportFormat::Pdf) {
        QBuffer pages(&bytes);
        pages.open(QIODevice::WriteOnly);
        if (auto set = writePdf(content, pages); !set) return set;
    } else {
        bytes = reportHtml(content);
    }
    if (const auto written = writeWholeFile(path.toStdString(), bytes.toStdString()); !written) {
        return fail(ErrorCode::Io, "The report could not be written to \"{}\": {}. Nothing was changed there.",
                    path.toStdString(), written.error().message);
    }
    return {};
}

}  // namespace tacto
