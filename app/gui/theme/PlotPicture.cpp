#include "app/gui/theme/PlotPicture.h"

#include <QBuffer>
#include <QClipboard>
#include <QFileInfo>
#include <QMessageBox>
#include <QPdfWriter>
#include <QPicture>
#include <QSvgGenerator>
#include <utility>

#include "app/gui/theme/Dialogs.h"
#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {

constexpr double kPictureScale = 2;  // sharp on paper and on a screen of twice the density
constexpr const char* kCaption = "pictureCaption";
using CaptionOf = std::function<PictureCaption()>;

/// The resolution of the layout: what is drawn stays vectors, and words stay as large as on the screen.
int pixelsPerInch() { return QPicture().logicalDpiX(); }

std::function<void(QCPPainter&)> replaying(const QPicture& picture) {
    return [picture](QCPPainter& painter) { painter.drawPicture(0, 0, picture); };
}

std::function<void(QCPPainter&)> recordingOf(QCustomPlot& plot) {
    QPicture picture;
    QCPPainter painter;
    painter.begin(&picture);
    painter.setMode(QCPPainter::pmVectorized);
    painter.setMode(QCPPainter::pmNoCaching);
    painter.setMode(QCPPainter::pmNonCosmetic);
    plot.toPainter(&painter, plot.width(), plot.height());
    painter.end();
    return replaying(picture);
}

std::function<void(QCPPainter&)> recordingOf(QWidget& widget) {
    QPicture picture;
    QPainter painter(&picture);
    widget.render(&painter, {}, {}, QWidget::DrawChildren);
    painter.end();
    return replaying(picture);
}

PictureCaption captionOf(const QCustomPlot& plot) {
    const auto caption = plot.property(kCaption).value<CaptionOf>();
    return caption ? caption() : PictureCaption{};
}

template <typename Device>
QByteArray vectorsOf(const Still& still, Device& device, QBuffer& buffer) {
    QCPPainter painter;
    painter.begin(&device);
    painter.setMode(QCPPainter::pmVectorized);
    painter.setMode(QCPPainter::pmNoCaching);
    still.draw(painter);
    painter.end();
    return buffer.data();
}

QByteArray svgOf(const Still& still) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    QSvgGenerator svg;
    svg.setOutputDevice(&buffer);
    svg.setSize(still.size());
    svg.setViewBox(QRect(QPoint(0, 0), still.size()));
    svg.setResolution(pixelsPerInch());
    svg.setTitle(still.title());
    return vectorsOf(still, svg, buffer);
}

QByteArray pdfOf(const Still& still) {
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    QPdfWriter pdf(&buffer);
    pdf.setResolution(pixelsPerInch());
    const QSizeF inches = QSizeF(still.size()) / pixelsPerInch();
    pdf.setPageSize(QPageSize(inches, QPageSize::Inch, {}, QPageSize::ExactMatch));
    pdf.setPageMargins({});
    pdf.setTitle(still.title());
    return vectorsOf(still, pdf, buffer);
}

QByteArray pngOf(const Still& still) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    pictureOf(still, kPictureScale).save(&buffer, "PNG");
    return bytes;
}

}  // namespace

Still::Still(QCustomPlot& plot) : Still(plot.size(), recordingOf(plot), captionOf(plot), plot.accessibleName()) {
    ground_ = plot.palette().color(QPalette::Base);
}

Still::Still(QWidget& widget, PictureCaption caption)
    : Still(widget.size(), recordingOf(widget), std::move(caption), widget.accessibleName()) {}

Still::Still(QSize size, std::function<void(QCPPainter&)> draw, PictureCaption caption, QString title)
    : size_(size),
      draw_(std::move(draw)),
      caption_(std::move(caption)),
      title_(std::move(title)),
      ground_(QApplication::palette().color(QPalette::Base)) {
    if (!caption_.title.isEmpty()) title_ = caption_.title;
}

CaptionLines Still::captionLines() const { return {caption_, size_.width() + 2 * caption_.margin()}; }

QSize Still::size() const {
    const int margin = caption_.margin();
    return {size_.width() + 2 * margin, captionLines().height() + size_.height() + margin};
}

void Still::draw(QCPPainter& painter) const {
    const auto caption = captionLines();
    painter.fillRect(QRect(QPoint(0, 0), size()), ground_);
    painter.save();
    caption.draw(painter);
    painter.restore();
    painter.save();
    painter.translate(caption_.margin(), caption.height());
    draw_(painter);
    painter.restore();
}

void captionPictures(QCustomPlot& plot, const CaptionOf& caption) {
    plot.setProperty(kCaption, QVariant::fromValue(caption));
}

void copyPicture(const Still& still) { QApplication::clipboard()->setImage(pictureOf(still, kPictureScale)); }

void askSavePicture(QWidget& parent, const Still& still, const QString& name) {
    FileQuestion question;
    question.title = QObject::tr("Save the plot");
    question.wants = FileQuestion::Wants::NewFile;
    question.filters << QObject::tr("Pictures (*.png *.svg *.pdf)");
    question.suffix = "png";
    question.name = name + ".png";
    askForFile(parent, question, [&parent, still](const QString& path) {
        if (const auto wrong = savePicture(still, path)) {
            openDialog(
                new QMessageBox(QMessageBox::Warning, QObject::tr("Not saved"), *wrong, QMessageBox::Ok, &parent));
        }
    });
}

QImage pictureOf(const Still& still, double scale) {
    QImage image((QSizeF(still.size()) * scale).toSize(), QImage::Format_ARGB32_Premultiplied);
    QCPPainter painter;
    painter.begin(&image);
    painter.setMode(QCPPainter::pmNoCaching);
    if (scale > 1) painter.setMode(QCPPainter::pmNonCosmetic);
    painter.scale(scale, scale);
    still.draw(painter);
    painter.end();
    return image;
}

std::optional<QString> savePicture(const Still& still, const QString& path) {
    const auto kind = QFileInfo(path).suffix().toLower();
    QByteArray bytes;
    if (kind == "png") {
        bytes = pngOf(still);
    } else if (kind == "svg") {
        bytes = svgOf(still);
    } else if (kind == "pdf") {
        bytes = pdfOf(still);
    } else {
        return QObject::tr("%1 was not saved: its name must end in .png, .svg or .pdf.").arg(path);
    }
    if (const auto written = writeWholeFile(path.toStdString(), bytes.toStdString()); !written) {
        return QObject::tr("%1 was not saved: %2. A file of that name is as it was.")
            .arg(path, QString::fromStdString(written.error().message));
    }
    return {};
}

void addPlotMenu(QCustomPlot& plot, const QString& name) {
    auto* copy = new QAction(QObject::tr("&Copy as picture"), &plot);
    QObject::connect(copy, &QAction::triggered, &plot, [&plot] { copyPicture(plot); });
    auto* store = new QAction(QObject::tr("&Save as…"), &plot);
    QObject::connect(store, &QAction::triggered, &plot, [&plot, name] { askSavePicture(plot, plot, name); });
    plot.addActions({copy, store});
    plot.setContextMenuPolicy(Qt::ActionsContextMenu);
    plot.setFocusPolicy(Qt::StrongFocus);
}

}  // namespace tacto::gui
