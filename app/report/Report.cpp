#include "app/report/Report.h"

#include <QFileInfo>
#include <QSaveFile>

#include "app/report/HtmlReport.h"
#include "app/report/PdfReport.h"

namespace tacto {

Result<ReportFormat> reportFormat(const QString& path) {
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending == "pdf") return ReportFormat::Pdf;
    if (ending == "html" || ending == "htm") return ReportFormat::Html;
    return fail(ErrorCode::InvalidArgument, "The report's file is \"{}\"; its name must end in .pdf, .html or .htm.",
                path.toStdString());
}

Result<void> writeReport(const ReportModel& model, const QString& path, const FontCheck& installed) {
    const auto format = reportFormat(path);
    if (!format) return failure(format);
    if (auto fonts = requireFonts(installed); !fonts) return fonts;

    QSaveFile file(path);
    const auto refused = [&] {
        return fail(ErrorCode::Io, "The report could not be written to \"{}\": {}. Nothing was changed there.",
                    path.toStdString(), file.errorString().toStdString());
    };
    if (!file.open(QIODevice::WriteOnly)) return refused();
    const ReportContent content = contentOf(model);
    if (*format == ReportFormat::Pdf) {
        if (auto written = writePdf(content, file); !written) {
            file.cancelWriting();
            return written;
        }
    } else {
        const QByteArray html = reportHtml(content);
        if (file.write(html) != html.size()) return refused();
    }
    // A disk that filled up is noticed here; the old report is still there then.
    if (!file.commit()) return refused();
    return {};
}

}  // namespace tacto
