// Curves over one pair of axes, each with its band, and horizontal lines to compare them with.
#include <array>

#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

QVector<double> vectorOf(const std::vector<double>& values) { return {values.begin(), values.end()}; }

QCPGraph* addGraph(QCPAxisRect* axes, const std::vector<double>& x, const std::vector<double>& y, const QPen& pen) {
    auto* graph = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    graph->setPen(pen);
    graph->setData(vectorOf(x), vectorOf(y));
    return graph;
}

void addBand(QCPAxisRect* axes, const CurvesFigure::Curve& curve, QColor color) {
    if (curve.low.empty()) return;
    const QPen edge(color, 0.6, Qt::DotLine);
    auto* bottom = addGraph(axes, curve.x, curve.low, edge);
    auto* top = addGraph(axes, curve.x, curve.high, edge);
    color.setAlpha(36);
    top->setBrush(color);
    top->setChannelFillGraph(bottom);
}

}  // namespace

std::unique_ptr<PlotSheet> drawCurves(const CurvesFigure& figure, bool simulated) {
    Reach x, y;
    for (const auto& curve : figure.curves) {
        for (const double value : curve.x) x.include(value);
        for (const auto* values : {&curve.y, &curve.low, &curve.high}) {
            for (const double value : *values) y.include(value);
        }
    }
    if (!std::isfinite(x.low) || !std::isfinite(y.low)) return emptySheet("There is no curve to draw.", simulated);
    y.include(0);
    for (const auto& line : figure.lines) y.include(line.y);

    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 280, simulated);
    auto* axes = sheet->addAxes(0, 0);
    auto* legend = sheet->addLegend(1, 0, 3);
    const std::array<QColor, 3> colors = {ink::kVoltage, ink::kCurrent, ink::kFault};
    for (std::size_t i = 0; i < figure.curves.size(); ++i) {
        const auto& curve = figure.curves[i];
        const QColor color = colors[i % colors.size()];
        addBand(axes, curve, color);
        // If there are more curves than colours, the additional curves are dashed.
        auto* graph =
            addGraph(axes, curve.x, curve.y, QPen(color, 1.4, i < colors.size() ? Qt::SolidLine : Qt::DashLine));
        if (curve.steps) graph->setLineStyle(QCPGraph::lsStepLeft);
        if (curve.x.size() <= 40) {
            graph->setScatterStyle({QCPScatterStyle::ssDisc, QPen(color, 1), QBrush(color), 4});
        }
        graph->setName(curve.label);
        graph->addToLegend(legend);
    }
    for (const auto& line : figure.lines) {
        auto* graph = addGraph(axes, {x.low, x.high}, {line.y, line.y}, QPen(ink::kAmber, 1.2, Qt::DashLine));
        graph->setName(line.label);
        graph->addToLegend(legend);
    }
    axes->axis(QCPAxis::atBottom)->setLabel(axisTitle(figure.x.label, figure.x.unit));
    axes->axis(QCPAxis::atLeft)->setLabel(axisTitle(figure.y.label, figure.y.unit));
    axes->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<PlainTicker>::create(8));
    axes->axis(QCPAxis::atLeft)->setTicker(QSharedPointer<PlainTicker>::create(6));
    axes->axis(QCPAxis::atBottom)->setRange(padded(x.low, x.high, 0.03));
    axes->axis(QCPAxis::atLeft)->setRange(padded(y.low, y.high, 0.05));
    sheet->watermark(axes);
    PlotSheet::fitLegend(legend);
    return sheet;
}

}  // namespace tacto
