#include "app/gui/calibrate/WiringPage.h"

#include <QLabel>
#include <QPainter>
#include <QSvgRenderer>
#include <QVBoxLayout>

#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kDrawingChars = 60;

/// On white in both themes: it is a drawing on paper.
QPixmap drawn(const QString& file, double scale) {
    QSvgRenderer renderer(file);
    QImage image((QSizeF(renderer.defaultSize()) * scale).toSize(), QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    renderer.render(&painter);
    painter.end();
    return QPixmap::fromImage(image);
}

}  // namespace

WiringPage::WiringPage(QWidget* parent) : QScrollArea(parent) {
    setObjectName("wiringPage");
    setAccessibleName(tr("Wiring"));
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    auto* says = new QLabel(
        tr("Before the run: <b>both oscilloscope grounds at one node</b>, or one of them shorts the load. The shunt "
           "stands in the low side; its drop is subtracted from the voltage by itself. No person is connected. The "
           "run then reads the known load first, and ends if that reads wrong. Simulated devices are wired like this."),
        page);
    says->setWordWrap(true);
    column->addWidget(says);
    const auto file = drawingFile("wiring");
    if (file) {
        auto* drawing = new QLabel(page);
        drawing->setObjectName("wiringDrawing");
        drawing->setAccessibleName(
            tr("Drawing: the stimulator's output goes through the load and then the shunt back to it; channel 1 across "
               "both, channel 2 across the shunt, both grounds at the stimulator's return"));
        const auto path = QString::fromStdString(file->string());
        const auto size = QSvgRenderer(path).defaultSize();
        const double scale =
            devicePixelRatioF() * fontMetrics().averageCharWidth() * kDrawingChars / std::max(1, size.width());
        auto picture = drawn(path, scale);
        picture.setDevicePixelRatio(devicePixelRatioF());
        drawing->setPixmap(picture);
        column->addWidget(drawing);
    } else {
        column->addWidget(new QLabel("⚠ " + QString::fromStdString(file.error().message), page));
    }
    column->addStretch();
    setWidget(page);
}

}  // namespace tacto::gui

#include "moc_WiringPage.cpp"
