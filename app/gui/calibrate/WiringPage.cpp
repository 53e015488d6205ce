#include "app/gui/calibrate/WiringPage.h"

#include <QLabel>
#include <QPainter>
#include <QSvgRenderer>
#include <QVBoxLayout>
#include <algorithm>

#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kDrawingChars = 60, kMinDrawingChars = 42;  // its width, and the least at which its words are read

/// As wide as its place lets it be. On white in both themes: it is a drawing on paper.
class WiringDrawing final : public QLabel {
public:
    WiringDrawing(const QString& file, QWidget* parent) : QLabel(parent), renderer_(file) {
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
        painter.fillRect(paper, Qt::white);
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
        auto* drawing = new WiringDrawing(QString::fromStdString(file->string()), page);
        drawing->setObjectName("wiringDrawing");
        drawing->setAccessibleName(
            tr("Drawing: the stimulator's output goes through the load and then the shunt back to it; channel 1 across "
               "both, channel 2 across the shunt, both grounds at the stimulator's return"));
        column->addWidget(drawing);
    } else {
        column->addWidget(new QLabel("⚠ " + QString::fromStdString(file.error().message), page));
    }
    column->addStretch();
    setWidget(page);
}

}  // namespace tacto::gui

#include "moc_WiringPage.cpp"
