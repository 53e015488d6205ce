#include "app/gui/calibrate/WiringPage.h"

#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QPainter>
#include <QSvgRenderer>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kDrawingChars = 60, kMinDrawingChars = 42;  // the drawing's usual and least readable width

/// Returns the report's drawing in the theme's colours and the window's font.
QByteArray inTheme(QByteArray svg) {
    const auto& c = colours();
    const auto replace = [&svg](const char* onPaper, const char* before, const QColor& here) {
        svg.replace(QByteArray(before) + onPaper, before + here.name().toUtf8());
    };
    replace("#009E73", "fill=\"", c.currentText);  // words
    replace("#009E73", "", c.current);
    replace("#0072B2", "", c.voltage);
    replace("#20242a", "", c.text);
    return svg.replace("DejaVu Sans", QApplication::font().family().toUtf8());
}

/// A drawing as wide as its place allows.
class WiringDrawing final : public QLabel {
public:
    WiringDrawing(const QByteArray& svg, QWidget* parent) : QLabel(parent), renderer_(inTheme(svg)) {
        onLookChange(*this, [this, svg] {
            renderer_.load(inTheme(svg));
            update();
        });
        auto policy = QSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
        policy.setHeightForWidth(true);
        setSizePolicy(policy);
    }
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override {
        const auto size = renderer_.defaultSize();
        return std::min(width, chars(kDrawingChars)) * size.height() / std::max(1, size.width());
    }
    [[nodiscard]] QSize sizeHint() const override { return sizeAt(kDrawingChars); }
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeAt(kMinDrawingChars); }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        const QRectF paper(0, 0, std::min(width(), chars(kDrawingChars)), heightForWidth(width()));
        painter.setRenderHint(QPainter::Antialiasing);
        renderer_.render(&painter, paper);
    }

private:
    [[nodiscard]] int chars(int count) const { return fontMetrics().averageCharWidth() * count; }
    [[nodiscard]] QSize sizeAt(int count) const { return {chars(count), heightForWidth(chars(count))}; }
    QSvgRenderer renderer_;
};

}  // namespace

WiringPage::WiringPage(QWidget* parent) : QScrollArea(parent) {
    nameWidget(*this, "wiringPage", tr("Wiring"));
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->addWidget(makeLabel(
        tr("Before the run: <b>both oscilloscope grounds at one node</b>, or one of them shorts the load. The shunt "
           "stands in the low side; its drop is subtracted from the voltage by itself. No person is connected. The "
           "run then reads the known load first, and ends if that reads wrong. Simulated devices are wired like this."),
        {.wraps = true}, page));
    const auto file = drawingFile("wiring");
    if (file) {
        QFile svg(QString::fromStdString(file->string()));
        static_cast<void>(svg.open(QIODevice::ReadOnly));  // the file exists: see drawingFile()
        auto* drawing = new WiringDrawing(svg.readAll(), page);
        nameWidget(
            *drawing, "wiringDrawing",
            tr("Drawing: the stimulator's output goes through the load and then the shunt back to it; channel 1 across "
               "both, channel 2 across the shunt, both grounds at the stimulator's return"));
        column->addWidget(drawing);
    } else {
        column->addWidget(new QLabel("⚠ " + QString::fromStdString(file.error().message), page));
    }
    column->addStretch();
    setWidget(page);
    for (auto* ground : {page, viewport()}) ground->setAutoFillBackground(false);  // shows the workspace's background
}

}  // namespace tacto::gui

#include "moc_WiringPage.cpp"
