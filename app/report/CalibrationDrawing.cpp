// Draws a calibration: readings around the fitted line, or each level's error with its uncertainty in the tolerance
// band. A second plot shows both sweep directions on a separate scale.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

struct Points {
    QVector<double> x, y;
    void add(double at, double value) {
        if (!std::isfinite(at) || !std::isfinite(value)) return;
        x << at;
        y << value;
    }
};

QCPGraph* addPoints(QCPAxisRect* axes, QCPLegend* legend, const Points& points, const QCPScatterStyle& style,
                    const QString& name) {
    auto* graph = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle(style);
    graph->setName(name);
    graph->setData(points.x, points.y);
    if (!points.x.isEmpty()) graph->addToLegend(legend);
    return graph;
}

QCPGraph* addLine(QCPAxisRect* axes, const Points& points, const QPen& pen, const QString& name) {
    auto* graph = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    graph->setPen(pen);
    graph->setName(name);
    graph->setData(points.x, points.y);
    return graph;
}

QCPScatterStyle triangle(bool up) {
    const auto shape = up ? QCPScatterStyle::ssTriangle : QCPScatterStyle::ssTriangleInverted;
    return {shape, QPen(up ? ink::kVoltage : ink::kThird, 1.1), QBrush(Qt::NoBrush), 6};
}

QCPScatterStyle cross() { return {QCPScatterStyle::ssCross, QPen(ink::kFault, 1.4), QBrush(Qt::NoBrush), 8}; }

void nameAxes(QCPAxisRect* axes, const CalibrationFigure& figure, const AxisUnit& x, const AxisUnit& y,
              const char* vertical) {
    axes->axis(QCPAxis::atBottom)->setLabel(axisTitle("Commanded " + figure.quantity, x.unit));
    axes->axis(QCPAxis::atLeft)->setLabel(axisTitle(QString::fromUtf8(vertical), y.unit));
    axes->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<PlainTicker>::create(8));
    axes->axis(QCPAxis::atLeft)->setTicker(QSharedPointer<PlainTicker>::create(6));
}

void drawMeasured(PlotSheet& sheet, QCPAxisRect* axes, QCPLegend* legend, const CalibrationFigure& figure) {
    Reach x, y;
    for (const auto& reading : figure.readings) {
        x.include(reading.commanded);
        y.include(reading.measured);
    }
    const bool line = std::isfinite(figure.gain) && std::isfinite(figure.offset);
    for (const double end : {x.low, x.high}) {
        if (line) y.include(figure.gain * end + figure.offset);
    }
    const AxisUnit across = axisUnit(x.magnitude(), figure.unit), upward = axisUnit(y.magnitude(), figure.unit);
    Points up, down, odd, fit;
    for (const auto& reading : figure.readings) {
        auto& into = reading.direction == "down" ? down : up;
        into.add(reading.commanded * across.factor, reading.measured * upward.factor);
        if (reading.outlier) odd.add(reading.commanded * across.factor, reading.measured * upward.factor);
    }
    if (line) {
        for (const double end : {x.low, x.high}) {
            fit.add(end * across.factor, (figure.gain * end + figure.offset) * upward.factor);
        }
        addLine(axes, fit, QPen(ink::kQuiet, 1), "fitted line")->addToLegend(legend);
    }
    addPoints(axes, legend, up, triangle(true), "reading, going up");
    addPoints(axes, legend, down, triangle(false), "reading, going down");
    addPoints(axes, legend, odd, cross(), "marked as standing out, kept");
    axes->axis(QCPAxis::atBottom)->setRange(padded(x.low * across.factor, x.high * across.factor, 0.04));
    axes->axis(QCPAxis::atLeft)->setRange(padded(y.low * upward.factor, y.high * upward.factor, 0.06));
    nameAxes(axes, figure, across, upward, "measured");
    sheet.watermark(axes);
}

void addUncertainty(QCPAxisRect* axes, const CalibrationFigure& figure, QCPGraph* means, double factor) {
    auto* bars = new QCPErrorBars(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    bars->setDataPlottable(means);
    bars->setPen(QPen(ink::kText, 1));
    bars->setErrorType(QCPErrorBars::etValueError);
    QVector<double> u;
    for (const auto& level : figure.levels) {
        if (std::isfinite(level.commanded) && std::isfinite(level.error)) {
            u << (std::isfinite(level.uncertainty) ? level.uncertainty * factor : 0);
        }
    }
    bars->setData(u);
}

/// Draws each direction's mean on a separate scale: hysteresis would be invisible next to a tolerance of 2 %.
void drawDirections(PlotSheet& sheet, QCPAxisRect* axes, QCPLegend* legend, const CalibrationFigure& figure) {
    Reach x, y;
    for (const auto& level : figure.levels) {
        x.include(level.commanded);
        y.include(level.meanUp - level.commanded);
        y.include(level.meanDown - level.commanded);
    }
    const AxisUnit across = axisUnit(x.magnitude(), figure.unit), upward = axisUnit(y.magnitude(), figure.unit);
    Points up, down;
    for (const auto& level : figure.levels) {
        up.add(level.commanded * across.factor, (level.meanUp - level.commanded) * upward.factor);
        down.add(level.commanded * across.factor, (level.meanDown - level.commanded) * upward.factor);
    }
    addLine(axes, up, QPen(ink::kVoltage, 0.8), {});
    addLine(axes, down, QPen(ink::kThird, 0.8, Qt::DashLine), {});
    addPoints(axes, legend, up, triangle(true), "mean going up");
    addPoints(axes, legend, down, triangle(false), "mean going down");
    axes->axis(QCPAxis::atBottom)->setRange(padded(x.low * across.factor, x.high * across.factor, 0.04));
    axes->axis(QCPAxis::atLeft)->setRange(padded(y.low * upward.factor, y.high * upward.factor, 0.1));
    nameAxes(axes, figure, across, upward, "error of each direction");
    sheet.watermark(axes);
}

void drawErrors(PlotSheet& sheet, QCPAxisRect* axes, QCPLegend* legend, const CalibrationFigure& figure) {
    Reach x, y;
    y.include(0);
    for (const auto& level : figure.levels) {
        x.include(level.commanded);
        for (const double side : {-1.0, 1.0}) {
            y.include(level.error + side * (std::isfinite(level.uncertainty) ? level.uncertainty : 0));
            y.include(side * level.tolerance);
        }
    }
    for (const auto& reading : figure.readings) {
        if (reading.outlier) y.include(reading.measured - reading.commanded);
    }
    const AxisUnit across = axisUnit(x.magnitude(), figure.unit), upward = axisUnit(y.magnitude(), figure.unit);
    Points low, high, mean, odd;
    for (const auto& level : figure.levels) {
        const double at = level.commanded * across.factor;
        low.add(at, -level.tolerance * upward.factor);
        high.add(at, level.tolerance * upward.factor);
        mean.add(at, level.error * upward.factor);
    }
    for (const auto& reading : figure.readings) {
        if (!reading.outlier) continue;
        odd.add(reading.commanded * across.factor, (reading.measured - reading.commanded) * upward.factor);
    }
    auto* bottom = addLine(axes, low, QPen(ink::kPass, 1.2, Qt::DashLine), "tolerance");
    auto* top = addLine(axes, high, QPen(ink::kPass, 1.2, Qt::DashLine), "tolerance");
    top->setBrush(QColor(ink::kPass.red(), ink::kPass.green(), ink::kPass.blue(), 28));
    top->setChannelFillGraph(bottom);
    bottom->addToLegend(legend);
    auto* means = addPoints(axes, legend, mean, {QCPScatterStyle::ssDisc, QPen(ink::kText, 1), QBrush(ink::kText), 4},
                            "mean, ± U");
    addUncertainty(axes, figure, means, upward.factor);
    addPoints(axes, legend, odd, cross(), "reading marked as standing out");
    axes->axis(QCPAxis::atBottom)->setRange(padded(x.low * across.factor, x.high * across.factor, 0.04));
    axes->axis(QCPAxis::atLeft)->setRange(padded(y.low * upward.factor, y.high * upward.factor, 0.06));
    nameAxes(axes, figure, across, upward, "measured \u2212 commanded");
    sheet.watermark(axes);
}

}  // namespace

std::unique_ptr<PlotSheet> drawCalibration(const CalibrationFigure& figure, bool simulated) {
    const bool readings = std::any_of(figure.readings.begin(), figure.readings.end(), [](const auto& reading) {
        return std::isfinite(reading.commanded) && std::isfinite(reading.measured);
    });
    const bool levels = std::any_of(figure.levels.begin(), figure.levels.end(), [](const auto& level) {
        return std::isfinite(level.commanded) && std::isfinite(level.error);
    });
    if (figure.errors ? !levels : !readings) return emptySheet("No level was measured.", simulated);
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, figure.errors ? 230 : 300, simulated);
    auto* axes = sheet->addAxes(0, 0);
    auto* legend = sheet->addLegend(1, 0, 3);
    if (figure.errors) {
        drawErrors(*sheet, axes, legend, figure);
        auto* directions = sheet->addLegend(1, 1, 3);
        drawDirections(*sheet, sheet->addAxes(0, 1), directions, figure);
        PlotSheet::fitLegend(directions);
    } else {
        drawMeasured(*sheet, axes, legend, figure);
    }
    PlotSheet::fitLegend(legend);
    return sheet;
}

}  // namespace tacto
