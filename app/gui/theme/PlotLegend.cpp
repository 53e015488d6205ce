#include "app/gui/theme/PlotLegend.h"

#include <memory>
#include <tuple>
#include <utility>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kBelow = 6;  // pixels between the legend and the axes

/// Sets the number of columns. A grid does not move existing entries, so they are added again.
void setWrap(QCustomPlot& plot, int columns) {
    auto* legend = plot.legend;
    if (legend->wrap() == columns) return;
    legend->setWrap(columns);
    for (int i = 0; i < plot.plottableCount(); ++i) plot.plottable(i)->removeFromLegend();
    for (int i = 0; i < plot.plottableCount(); ++i) plot.plottable(i)->addToLegend();
    fitLegend(plot);
}

void fitRows(QCustomPlot& plot) {
    auto* legend = plot.legend;
    const int entries = legend->itemCount();
    for (int rows = 1; rows <= entries; ++rows) {
        setWrap(plot, rows == 1 ? 0 : (entries + rows - 1) / rows);
        if (legend->minimumOuterSizeHint().width() <= plot.width()) return;
    }
}

}  // namespace

void putLegendAbove(QCustomPlot& plot) {
    auto* legend = plot.legend;
    plot.axisRect()->insetLayout()->take(legend);
    plot.plotLayout()->insertRow(0);
    // The legend needs its own grid with a filler next to it, or its maximum width would limit the axes.
    auto* line = new QCPLayoutGrid;
    plot.plotLayout()->addElement(0, 0, line);
    plot.plotLayout()->setRowStretchFactor(0, 0.001);
    plot.axisRect()->setMinimumMargins(QMargins(15, kBelow, 15, 15));
    line->addElement(0, 0, legend);
    auto* rest = new QCPTextElement(&plot);
    rest->setMinimumSize(1, 1);
    rest->setMaximumSize(QWIDGETSIZE_MAX, 1);
    line->addElement(0, 1, rest);
    legend->setFillOrder(QCPLayoutGrid::foColumnsFirst);
    legend->setWrap(0);
    fitLegend(plot);
}

void fitLegend(QCustomPlot& plot) {
    auto* legend = plot.legend;
    const auto& c = colours();
    legend->setTextColor(c.text);
    legend->setBrush(QBrush(c.base));
    legend->setBorderPen(Qt::NoPen);
    legend->setFont(textFont(TextSize::Small));
    legend->setIconSize(scaledPx(24), QFontMetrics(legend->font()).height());  // the symbol is level with the text
    legend->setColumnSpacing(scaledPx(14));
    legend->setRowSpacing(0);
    legend->setMargins(QMargins(scaledPx(8), 2, scaledPx(8), 2));
    legend->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
    // A hidden legend leaves its room to the axes.
    legend->setMinimumSize(legend->visible() ? QSize(0, 0) : QSize(1, 1));
    legend->setMaximumSize(legend->visible() ? legend->minimumOuterSizeHint() : QSize(1, 1));
}

void wrapLegend(QCustomPlot& plot) {
    using Fitted = std::tuple<int, int, QFont>;
    const auto fitted = std::make_shared<Fitted>();
    QObject::connect(&plot, &QCustomPlot::beforeReplot, &plot, [&plot, fitted] {
        const auto* legend = plot.legend;
        if (!legend->visible()) return;
        const Fitted now(plot.width(), legend->itemCount(), legend->font());
        if (std::exchange(*fitted, now) != now) fitRows(plot);
    });
}

void drawLineIcon(QCPPainter& painter, const QRectF& icon, const QPen& pen) {
    painter.setPen(pen);
    painter.drawLine(QLineF(icon.left(), icon.center().y(), icon.right(), icon.center().y()));
}

}  // namespace tacto::gui
