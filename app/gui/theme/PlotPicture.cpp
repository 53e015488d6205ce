#include "app/gui/theme/PlotPicture.h"

#include <QBuffer>
#include <QClipboard>
#include <QFileInfo>
#include <QMessageBox>
#include <QPdfWriter>
#include <QSvgGenerator>

#include "app/gui/theme/Dialogs.h"
#include "app/report/WholeFile.h"

namespace tacto::gui {

namespace {

constexpr int kPixelsPerInch = 96;
constexpr double kPictureScale = 2;  // sharp on paper and on a screen of twice the density

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
    svg.setTitle(plot.accessibleName());
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
    pdf.setTitle(plot.accessibleName());
    paint(plot, pdf);
    return bytes;
}

QByteArray pngOf(QCustomPlot& plot) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    pictureOf(plot, kPictureScale).save(&buffer, "PNG");
    return bytes;
}

}  // namespace

void copyPicture(QCustomPlot& plot) { QApplication::clipboard()->setImage(pictureOf(plot, kPictureScale)); }

void askSavePicture(QCustomPlot& plot, const QString& name) {
    FileQuestion question;
    question.title = QObject::tr("Save the plot");
    question.wants = FileQuestion::Wants::NewFile;
    question.filters << QObject::tr("Pictures (*.png *.svg *.pdf)");
    question.suffix = "png";
    question.name = name + ".png";
    askForFile(plot, question, [&plot](const QString& path) {
        if (const auto wrong = savePicture(plot, path)) {
            openDialog(new QMessageBox(QMessageBox::Warning, QObject::tr("Not saved"), *wrong, QMessageBox::Ok, &plot));
        }
    });
}

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
    if (const auto written = writeWholeFile(path, bytes); !written) {
        return QObject::tr("%1 was not saved: %2. A file of that name is as it was.")
            .arg(path, QString::fromStdString(written.error().message));
    }
    return {};
}

void addPlotMenu(QCustomPlot& plot, const QString& name) {
    auto* copy = new QAction(QObject::tr("&Copy as picture"), &plot);
    QObject::connect(copy, &QAction::triggered, &plot, [&plot] { copyPicture(plot); });
    auto* store = new QAction(QObject::tr("&Save as…"), &plot);
    QObject::connect(store, &QAction::triggered, &plot, [&plot, name] { askSavePicture(plot, name); });
    plot.addActions({copy, store});
    plot.setContextMenuPolicy(Qt::ActionsContextMenu);
    plot.setFocusPolicy(Qt::StrongFocus);
}

}  // namespace tacto::gui
