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

/// The colour of each curve: that of the condition of this name, else one of its own.
ConditionStyle styleOf(const CurvesFigure::Curve& curve, std::size_t place) {
    static const std::array<QColor, 3> kFirst = {ink::kVoltage, ink::kCurrent, ink::kFault};
    static const QStringList kConditions = {"smooth-low", "smooth-high", "rough-low", "rough-high"};
    if (place >= kFirst.size() || kConditions.contains(curve.label))
        return conditionStyle(curve.label, static_cast<int>(place));
    return {kFirst[place], Qt::SolidLine, QCPScatterStyle::ssDisc};
}

/// Points with their bars; a point with more trials is larger.
void addPoints(QCPAxisRect* axes, const CurvesFigure::Curve& curve, const QColor& color, QCPLegend* legend) {
    constexpr double kSize = 7, kMinSize = 4, kMaxSize = 13;
    auto* named = addGraph(axes, curve.x, curve.y, Qt::NoPen);
    named->setLineStyle(QCPGraph::lsNone);
    const QBrush fill = curve.open ? QBrush(Qt::white) : QBrush(color);
    const auto disc = [&](double size) {
        return QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(color, 1.2), fill, size);
    };
    named->setScatterStyle(disc(kSize));
    named->setName(curve.label);
    if (!curve.label.isEmpty()) named->addToLegend(legend);
    if (!curve.low.empty()) {
        auto* bars = new QCPErrorBars(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        bars->setPen(QPen(color, 1));
        bars->setDataPlottable(named);
        QVector<double> below, above;
        for (std::size_t i = 0; i < curve.y.size(); ++i) {
            below << curve.y[i] - curve.low[i];
            above << curve.high[i] - curve.y[i];
        }
        bars->setData(below, above);
    }
    if (curve.n.empty()) return;
    const double most = *std::ranges::max_element(curve.n);
    named->setVisible(false);  // only its entry in the legend and its bars are seen
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        auto* one = addGraph(axes, {curve.x[i]}, {curve.y[i]}, Qt::NoPen);
        one->setLineStyle(QCPGraph::lsNone);
        one->setScatterStyle(
            disc(most > 0 ? kMinSize + (kMaxSize - kMinSize) * std::sqrt(curve.n[i] / most) : kMinSize));
    }
}

/// `step`: between ticks; 0: about `ticks` ticks.
void nameTicks(QCPAxis* axis, const CurvesFigure::Axis& named, int ticks, double step = 0) {
    axis->setLabel(axisTitle(named.label, named.unit));
    if (named.names.isEmpty()) {
        axis->setTicker(QSharedPointer<PlainTicker>::create(ticks, step));
        return;
    }
    auto texts = QSharedPointer<QCPAxisTickerText>::create();
    for (qsizetype i = 0; i < named.names.size(); ++i) texts->addTick(static_cast<double>(i + 1), named.names[i]);
    axis->setTicker(texts);
}

/// A whole step for a short axis of counts without a unit, such as numbers of trials; otherwise 0.
double countingStep(const CurvesFigure& figure, const Reach& x) {
    constexpr double kMaxCount = 60;
    if (!figure.x.unit.isEmpty() || !(x.high - x.low <= kMaxCount)) return 0;
    for (const auto& curve : figure.curves) {
        if (std::ranges::any_of(curve.x, [](double value) { return value != std::floor(value); })) return 0;
    }
    return x.high - x.low <= 8 ? 1 : x.high - x.low <= 20 ? 2 : x.high - x.low <= 40 ? 5 : 10;
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
    for (qsizetype i = 0; i < figure.x.names.size(); ++i) {  // half a place is free at both ends
        x.include(static_cast<double>(i) + 0.5);
        x.include(static_cast<double>(i) + 1.5);
    }

    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 280, simulated);
    auto* axes = sheet->addAxes(0, 0);
    auto* legend = sheet->addLegend(1, 0, 3);
    for (std::size_t i = 0; i < figure.curves.size(); ++i) {
        const auto& curve = figure.curves[i];
        const auto style = styleOf(curve, i);
        if (curve.points) {
            addPoints(axes, curve, style.color, legend);
            continue;
        }
        addBand(axes, curve, style.color);
        auto* graph = addGraph(axes, curve.x, curve.y, style.pen(1.4));
        if (curve.steps) graph->setLineStyle(QCPGraph::lsStepLeft);
        if (curve.x.size() <= 40)
            graph->setScatterStyle({QCPScatterStyle::ssDisc, QPen(style.color, 1), QBrush(style.color), 4});
        graph->setName(curve.label);
        graph->addToLegend(legend);
    }
    for (const auto& line : figure.lines) {
        auto* graph = addGraph(axes, {x.low, x.high}, {line.y, line.y}, QPen(ink::kAmber, 1.2, Qt::DashLine));
        graph->setName(line.label);
        graph->addToLegend(legend);
    }
    nameTicks(axes->axis(QCPAxis::atBottom), figure.x, 8, countingStep(figure, x));
    nameTicks(axes->axis(QCPAxis::atLeft), figure.y, 6);
    axes->axis(QCPAxis::atBottom)->setRange(padded(x.low, x.high, 0.03));
    axes->axis(QCPAxis::atLeft)->setRange(padded(y.low, y.high, 0.05));
    sheet->watermark(axes);
    PlotSheet::fitLegend(legend);
    return sheet;
}

}  // namespace tacto
