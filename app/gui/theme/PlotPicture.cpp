#include "app/gui/theme/PlotPicture.h"

#include <QBuffer>
#include <QClipboard>
#include <QFileInfo>
#include <QMessageBox>
#include <QPdfWriter>
#include <QPicture>
#include <QSvgGenerator>
#include <QWidget>
#include <cmath>
#include <utility>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/Told.h"
#include "app/gui/theme/ToolRow.h"
#include "app/report/NumberText.h"
#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {

constexpr double kPictureScale = 2;  // sharp on paper and on high-density screens
constexpr const char* kCaption = "pictureCaption";
using CaptionOf = std::function<PictureCaption()>;

/// The resolution of the layout: the drawing stays vectors, and text keeps its size on the screen.
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

void copyPicture(const Still& still) {
    QApplication::clipboard()->setImage(pictureOf(still, kPictureScale));
    tell(QObject::tr("The picture is on the clipboard."));
}

void askSavePicture(QWidget& parent, const Still& still, const QString& name) {
    FileQuestion question{.title = QObject::tr("Save the plot"),
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {QObject::tr("Pictures (*.png *.svg *.pdf)")},
                          .name = name + ".png",
                          .suffix = "png"};
    askForFile(parent, question, [&parent, still](const QString& path) {
        const auto wrong = savePicture(still, path);
        if (!wrong) return tell(QObject::tr("The picture is saved to %1.").arg(path));
        openDialog(new QMessageBox(QMessageBox::Warning, QObject::tr("Not saved"), *wrong, QMessageBox::Ok, &parent));
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
        return QObject::tr("%1 was not saved: %2. An existing file of that name was not changed.")
            .arg(path, QString::fromStdString(written.error().message));
    }
    return {};
}

void addPlotMenu(QCustomPlot& plot, const QString& name) {
    auto* copy = new QAction(QObject::tr("&Copy as picture"), &plot);
    QObject::connect(copy, &QAction::triggered, &plot, [&plot] { copyPicture(plot); });
    auto* store = new QAction(QObject::tr("&Save as…"), &plot);
    store->setObjectName(kSavePlot);
    QObject::connect(store, &QAction::triggered, &plot, [&plot, name] { askSavePicture(plot, plot, name); });
    plot.addActions({copy, store});
    plot.setContextMenuPolicy(Qt::ActionsContextMenu);
    plot.setFocusPolicy(Qt::StrongFocus);
}

namespace {

constexpr int kCaptionAbove = PictureCaption::kMargin, kCaptionBelow = 8;
constexpr int kAxisDigits = 4;

QFont titleFont() { return textFont(TextSize::Large, QFont::DemiBold); }

/// Text that is too wide continues in another line.
constexpr int kWrapped = int(Qt::AlignLeft | Qt::AlignTop) | Qt::TextWordWrap;

int heightOf(const QString& text, const QFont& font, int width) {
    const QRect room(0, 0, width - 2 * PictureCaption::kMargin, QWIDGETSIZE_MAX);
    return text.isEmpty() ? 0 : QFontMetrics(font).boundingRect(room, kWrapped, text).height();
}

/// Allows line breaks only between readings (which are three blanks apart), not within one.
QString readingsKeptWhole(QString line) {
    static const QRegularExpression within("(?<! ) (?! )");
    return line.contains(QStringLiteral("   ")) ? line.replace(within, QString(QChar(QChar::Nbsp))) : line;
}

QString boundText(double value) { return settingText(QString::number(value, 'g', kAxisDigits).toDouble(), {}); }

}  // namespace

QString pictureTitle(const QString& title, bool simulated) {
    return simulated ? QObject::tr("%1 · simulated").arg(title) : title;
}

QString pictureDate(const QDateTime& taken) {
    const auto minutes = taken.offsetFromUtc() / 60;
    const auto zone = minutes == 0 ? QString()
                                   : QStringLiteral("%1%2:%3")
                                         .arg(minutes < 0 ? QStringLiteral("−") : QStringLiteral("+"))
                                         .arg(std::abs(minutes) / 60, 2, 10, QLatin1Char('0'))
                                         .arg(std::abs(minutes) % 60, 2, 10, QLatin1Char('0'));
    return QLocale::c().toString(taken, "yyyy-MM-dd HH:mm:ss") + " UTC" + zone;
}

QString deviceNames(const std::vector<SessionDevice>& devices) {
    QStringList names;
    for (const auto& device : devices) {
        auto name = qtext(device.name);
        if (!device.serial.empty()) name += " " + qtext(device.serial);
        if (device.simulated && !name.contains(QObject::tr("simulated"))) name += QObject::tr(" (simulated)");
        names << name;
    }
    return names.join(QStringLiteral(" · "));
}

QString axesText(const QCustomPlot& plot) {
    QStringList parts;
    for (const auto* axes : plot.axisRects()) {
        for (const auto side : {QCPAxis::atBottom, QCPAxis::atLeft, QCPAxis::atRight}) {
            for (const auto* axis : axes->axes(side)) {
                if (!axis->visible() || axis->label().isEmpty()) continue;
                parts << QObject::tr("%1 %2 to %3")
                             .arg(axis->label(), boundText(axis->range().lower), boundText(axis->range().upper));
            }
        }
    }
    return parts.join(QStringLiteral(" · "));
}

CaptionLines::CaptionLines(const PictureCaption& caption, int width) : title_(caption.title), width_(width) {
    if (caption.empty()) return;
    QStringList rest;
    for (const auto& line : QStringList{caption.date} + caption.lines)
        if (!line.isEmpty()) rest << readingsKeptWhole(line);
    rest_ = rest.join('\n');
    height_ = kCaptionAbove + heightOf(title_, titleFont(), width) + heightOf(rest_, textFont(TextSize::Small), width) +
              kCaptionBelow;
}

void CaptionLines::draw(QPainter& painter) const {
    if (height_ == 0) return;
    painter.setPen(colours().text);
    int top = kCaptionAbove;
    for (const auto& [text, font] : {std::pair(title_, titleFont()), {rest_, textFont(TextSize::Small)}}) {
        const int height = heightOf(text, font, width_);
        painter.setFont(font);
        painter.drawText(QRect(PictureCaption::kMargin, top, width_ - 2 * PictureCaption::kMargin, height), kWrapped,
                         text);
        top += height;
    }
}

PictureTools::PictureTools(QWidget* parent)
    : QObject(parent),
      save_(makeTool(tr("Save picture"), tr("Saves what is shown as a picture: PNG, SVG or PDF."), "save", parent)),
      copy_(makeTool(tr("Copy picture"), tr("Copies what is shown to the clipboard, as a picture."), "copy", parent)),
      plotOnly_(makeTool(tr("Plot only"), tr("F11: the safety bar and the plot alone; F11 again brings the rest back."),
                         "plot-only", parent)) {
    connect(plotOnly_, &QToolButton::clicked, this, &PictureTools::plotOnlyWanted);
}

void PictureTools::addTo(QLayout& row) {
    for (auto* button : buttons()) row.addWidget(button);
}

void PictureTools::takeFrom(const std::function<Still()>& shown, const QString& name) {
    shown_ = shown;
    connect(save_, &QToolButton::clicked, this,
            [this, shown, name] { askSavePicture(*save_->parentWidget(), shown(), name); });
    connect(copy_, &QToolButton::clicked, this, [shown] { copyPicture(shown()); });
}

}  // namespace tacto::gui

#include "moc_PlotPicture.cpp"
