// The largest step between trains over the plane of roughness R and pressure P. Each cell has a number.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

/// Returns blue up to `wanted`, amber above; deeper for larger values, and deepest at four times `wanted`.
QColor colourOf(double jnd, double wanted) {
    const auto blend = [](const QColor& to, double share) {
        const auto mix = [share](int from, int end) {
            return from + static_cast<int>(std::lround(share * (end - from)));
        };
        return QColor(mix(255, to.red()), mix(255, to.green()), mix(255, to.blue()));
    };
    if (jnd <= wanted) return blend(ink::kVoltage, 0.45 * jnd / wanted);
    return blend(ink::kAmber, std::min(1.0, 0.35 + 0.65 * (jnd - wanted) / (3 * wanted)));
}

/// Formats the number for a cell: "0.4", "12".
QString jndText(double jnd) { return QString::number(jnd, 'f', jnd < 9.95 ? 1 : 0); }

void addCell(QCPAxisRect* axes, double x, double y, double half, const QPen& pen, const QBrush& brush) {
    auto* cell = new QCPItemRect(axes->parentPlot());
    if (brush.style() != Qt::NoBrush) cell->setLayer("grid");  // below the watermark, which must stay readable
    for (auto* corner : {cell->topLeft, cell->bottomRight}) {
        corner->setAxisRect(axes);
        corner->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        corner->setType(QCPItemPosition::ptPlotCoords);
    }
    cell->topLeft->setCoords(x - half, y + half);
    cell->bottomRight->setCoords(x + half, y - half);
    cell->setClipToAxisRect(false);
    cell->setPen(pen);
    cell->setBrush(brush);
}

void addNumber(QCPAxisRect* axes, double x, double y, const QString& number, double points) {
    auto* text = new QCPItemText(axes->parentPlot());
    text->position->setAxisRect(axes);
    text->position->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    text->position->setType(QCPItemPosition::ptPlotCoords);
    text->position->setCoords(x, y);
    text->setClipToAxisRect(false);
    text->setFont(textFont(points));
    text->setColor(ink::kText);
    text->setText(number);
}

/// The axis shows only 0 and 1, the ends of the plane; the cells at its edges extend further.
QSharedPointer<QCPAxisTicker> ends() {
    auto ticks = QSharedPointer<QCPAxisTickerText>::create();
    for (int fifth = 0; fifth <= 5; ++fifth) ticks->addTick(0.2 * fifth, QString::number(0.2 * fifth, 'f', 1));
    return ticks;
}

void drawMap(PlotSheet& sheet, int column, const QString& title, const TransitionsFigure::Map& map, double wanted) {
    const QString largest =
        std::isfinite(map.largest.jnd) ? QString(": at most %1").arg(jndText(map.largest.jnd)) : QString();
    sheet.addTitle(0, column, title + largest, true);
    auto* axes = sheet.addAxes(1, column);
    const std::size_t n = map.cells.size();
    const bool known = std::any_of(map.cells.begin(), map.cells.end(), [](const auto& row) {
        return std::any_of(row.begin(), row.end(), [](double cell) { return std::isfinite(cell); });
    });
    if (n < 2 || !known) {
        sheet.explain(axes, "No step was swept.");
        return;
    }
    sheet.watermark(axes);
    const double step = 1.0 / static_cast<double>(n - 1);
    const double half = step / 2;
    for (const auto side : {QCPAxis::atBottom, QCPAxis::atLeft}) {
        axes->axis(side)->setRange(-half, 1 + half);
        axes->axis(side)->grid()->setVisible(false);
        axes->axis(side)->setTicker(ends());
    }
    axes->axis(QCPAxis::atBottom)->setLabel(axisTitle("Roughness R"));
    axes->axis(QCPAxis::atLeft)->setLabel(axisTitle("Pressure P"));
    const bool numbered = n <= 13;
    for (std::size_t p = 0; p < n; ++p) {
        for (std::size_t r = 0; r < n; ++r) {
            const double x = static_cast<double>(r) * step, y = static_cast<double>(p) * step;
            const double jnd = map.cells[p][r];
            const bool seen = std::isfinite(jnd);
            addCell(axes, x, y, half, QPen(ink::kGrid, 0.5),
                    seen ? QBrush(colourOf(jnd, wanted)) : QBrush(ink::kGrid, Qt::BDiagPattern));
            if (seen && numbered) addNumber(axes, x, y, jndText(jnd), n <= 8 ? 9 : 7.5);
        }
    }
    if (!(map.largest.jnd > 0)) return;
    const auto centre = [step](double place) { return std::round(place / step) * step; };
    addCell(axes, centre(map.largest.roughness), centre(map.largest.pressure), half, QPen(ink::kText, 1.8),
            Qt::NoBrush);
}

}  // namespace

std::unique_ptr<PlotSheet> drawTransitions(const TransitionsFigure& figure, bool simulated) {
    if (figure.amplitude.cells.empty() && figure.interval.cells.empty()) {
        return emptySheet("No step was swept.", simulated);
    }
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 340, simulated);
    drawMap(*sheet, 0, "Amplitude", figure.amplitude, figure.wanted_jnd);
    drawMap(*sheet, 1, "Interval", figure.interval, figure.wanted_jnd);
    sheet->plot().plotLayout()->setRowStretchFactor(0, 0.01);
    return sheet;
}

}  // namespace tacto
