#include "app/gui/scope/ScopeExport.h"

#include <QBuffer>
#include <QFileInfo>
#include <QObject>
#include <QPdfWriter>
#include <QSaveFile>
#include <QSvgGenerator>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <qcustomplot.h>

#include "core/measure/CaptureFile.h"

namespace tacto::gui {

namespace {

constexpr int kPixelsPerInch = 96;

void paint(QCustomPlot& plot, QPaintDevice& device) {
    QCPPainter painter;
    painter.begin(&device);
    painter.setMode(QCPPainter::pmVectorized);
    painter.setMode(QCPPainter::pmNoCaching);
    painter.fillRect(QRect(QPoint(0, 0), plot.size()), plot.palette().base());
    plot.toPainter(&painter, plot.width(), plot.height());
    painter.end();
}

QByteArray svgOf(QCustomPlot& plot) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    QSvgGenerator svg;
    svg.setOutputDevice(&buffer);
    svg.setSize(plot.size());
    svg.setViewBox(QRect(QPoint(0, 0), plot.size()));
    svg.setResolution(kPixelsPerInch);
    svg.setTitle(QObject::tr("Oscilloscope"));
    paint(plot, svg);
    return bytes;
}

QByteArray pdfOf(QCustomPlot& plot) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    QPdfWriter pdf(&buffer);
    pdf.setResolution(kPixelsPerInch);  // of the layout: what is drawn stays vectors
    const QSizeF inches = QSizeF(plot.size()) / kPixelsPerInch;
    pdf.setPageSize(QPageSize(inches, QPageSize::Inch, {}, QPageSize::ExactMatch));
    pdf.setPageMargins({});
    pdf.setTitle(QObject::tr("Oscilloscope"));
    paint(plot, pdf);
    return bytes;
}

QByteArray pngOf(QCustomPlot& plot) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    pictureOf(plot, 2).save(&buffer, "PNG");
    return bytes;
}

}  // namespace

QImage pictureOf(QCustomPlot& plot, double scale) {
    return plot.toPixmap(plot.width(), plot.height(), scale).toImage();
}

std::optional<QString> savePicture(QCustomPlot& plot, const QString& path) {
    const auto kind = QFileInfo(path).suffix().toLower();
    QByteArray bytes;
    if (kind == "png") {
        bytes = pngOf(plot);
    } else if (kind == "svg") {
        bytes = svgOf(plot);
    } else if (kind == "pdf") {
        bytes = pdfOf(plot);
    } else {
        return QObject::tr("%1 was not saved: its name must end in .png, .svg or .pdf.").arg(path);
    }
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit()) {
        return QObject::tr("%1 was not saved: %2. A file of that name is as it was.").arg(path, file.errorString());
    }
    return {};
}

std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s, const QString& path) {
    const auto& whole = *shown.capture;
    const auto index = [&](double t) {
        const double at = std::ceil((t - whole.start_s) * whole.rate_hz - 1e-6);
        return static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, static_cast<double>(whole.samples())));
    };
    const auto first = index(from_s), last = index(to_s);
    if (first >= last) return QObject::tr("No data were saved: no sample is on the screen.");
    Capture part;
    part.rate_hz = whole.rate_hz;
    part.start_s = whole.start_s + static_cast<double>(first) / whole.rate_hz;
    for (const auto& trace : shown.traces) {
        CaptureChannel channel;
        channel.name = trace->key.section('/', 1).toStdString();
        channel.unit = trace->unit.toStdString();
        channel.samples.assign(trace->samples->begin() + first, trace->samples->begin() + last);
        part.channels.push_back(std::move(channel));
    }
    // Beside the file and then in its place: who reads it never sees half of it.
    const std::filesystem::path target(path.toStdString());
    std::filesystem::path beside = target;
    beside += ".part";
    const auto failed = [&](const std::string& why) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        return QObject::tr("%1 was not saved: %2. A file of that name is as it was.")
            .arg(path, QString::fromStdString(why));
    };
    if (const auto written = writeCapture(beside, part); !written) return failed(written.error().message);
    std::error_code error;
    std::filesystem::rename(beside, target, error);
    if (error) return failed(error.message());
    return {};
}

}  // namespace tacto::gui
