#include "app/gui/calibrate/CalibrationPlot.h"

#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/report/FigureDrawing.h"
#include "app/report/PlotSheet.h"
#include "app/report/ShownText.h"
#include "app/report/TableContent.h"

namespace tacto::gui {

namespace {

constexpr double kMargin = 0.06;
constexpr int kTicks = 5;
constexpr int kEdge = 4, kEdgeAbove = 1;         // pixels around the axes
constexpr int kBelowTicks = 2, kBelowTitle = 0;  // around the title below; small, to fit a small window
constexpr int kMinChars = 24;
constexpr int kMinLines = 10;
constexpr int kLegendColumns = 2;
constexpr double kAside = 0.006;   // share of the range: upward readings left of their level, downward right
constexpr double kNearest = 0.02;  // share of the range: half the frame's width at the nearest level
constexpr double kNearestBottom = 0.98,
                 kLeadFrom = 0.8;  // shares of the frame's height from the top: of its words, and of the line to them

QCPRange rangeOf(const Reach& reach, double factor) {
    return reach.known() ? padded(reach.low * factor, reach.high * factor, kMargin) : QCPRange(0, 1);
}

double bandAt(const CalibrationReadings& of, double command) { return of.tolerance_pct / 100 * std::abs(command); }

}  // namespace

CalibrationPlot::CalibrationPlot(Kind kind, QWidget* parent) : QCustomPlot(parent), kind_(kind) {
    const bool errors = kind == Kind::Errors;
    setAccessibleName(errors ? tr("Error and tolerance") : tr("Measured against commanded"));
    setToolTip(errors ? tr("How far each reading lies from its command, inside or outside the tolerance band. A dot is "
                           "a level's mean with its uncertainty. A cross marks an outlier, which is kept.")
                      : tr("Each reading against its command, with the fitted line. Triangles point the way the sweep "
                           "went. A cross marks an outlier, which is kept."));
    build();
    addPlotMenu(*this, errors ? "calibration-errors" : "calibration");
    // Set here, since otherwise the one-row legend would limit how narrow the window can become.
    setMinimumSize(fontMetrics().averageCharWidth() * kMinChars, fontMetrics().height() * kMinLines);
    clear();
    onLookChange(*this, [this] {
        colour();
        replot(QCustomPlot::rpQueuedReplot);
    });
}

void CalibrationPlot::build() {
    bandBottom_ = addGraph();
    bandTop_ = addGraph();
    bandTop_->setChannelFillGraph(bandBottom_);
    for (auto* edge : {bandTop_, bandBottom_}) edge->setLayer("background");  // below grid and watermark
    for (auto** graph : {&line_, &nominal_, &up_, &down_, &marked_, &means_}) *graph = addGraph();
    for (auto* graph : {up_, down_, marked_, means_}) graph->setLineStyle(QCPGraph::lsNone);
    bars_ = new QCPErrorBars(xAxis, yAxis);
    bars_->setDataPlottable(means_);
    bars_->setErrorType(QCPErrorBars::etValueError);
    up_->setName(tr("going up"));
    down_->setName(tr("going down"));
    marked_->setName(tr("outlier, kept"));
    means_->setName(tr("mean ± U (95 %)"));
    bandTop_->setName(tr("tolerance"));
    axisRect()->setMinimumMargins(QMargins(kEdge, kEdgeAbove, kEdge, kEdge));
    xAxis->setLabelPadding(kBelowTicks);
    xAxis->setPadding(kBelowTitle);
    addLegend();
    watermark_ = addWatermark(*axisRect());
    watermark_->setVisible(false);
    nearest_ = new QCPItemRect(this);
    nearestText_ = new QCPItemText(this);
    nearestTitle_ = new QCPItemText(this);
    nearestTitle_->setText(tr("Nearest to the tolerance"));
    nearestLead_ = new QCPItemLine(this);
    nearestLead_->start->setParentAnchor(nearest_->bottom);
    nearestLead_->end->setParentAnchorX(nearest_->bottom);
    nearestLead_->end->setParentAnchorY(nearestTitle_->top);
    hideNearest();
    empty_ = new QCPItemText(this);
    empty_->position->setType(QCPItemPosition::ptAxisRectRatio);
    empty_->position->setCoords(0.5, 0.5);
}

/// The legend is in the corner that the band leaves free: levels at the left edge have the smallest tolerance.
void CalibrationPlot::addLegend() {
    axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignLeft);
    legend->setFillOrder(QCPLayoutGrid::foColumnsFirst);
    legend->setWrap(kLegendColumns);
    legend->clearItems();
    line_->setName(tr("fitted line"));
    const auto named =
        kind_ == Kind::Errors ? std::vector{up_, means_, down_, bandTop_} : std::vector{up_, line_, down_};
    for (auto* graph : named) graph->addToLegend();
}

void CalibrationPlot::clear(const QString& why) {
    for (auto* graph : {bandBottom_, bandTop_, line_, nominal_, up_, down_, marked_, means_}) graph->data()->clear();
    hideNearest();
    bars_->setData(QVector<double>());
    for (auto* axis : {xAxis, yAxis}) axis->setTickLabels(false);
    xAxis->setLabel(tr("Commanded"));
    yAxis->setLabel(kind_ == Kind::Errors ? tr("Measured − commanded") : tr("Measured"));
    legend->setVisible(false);
    empty_->setVisible(true);
    empty_->setText(!why.isEmpty()          ? why
                    : kind_ == Kind::Errors ? tr("Each reading's error appears here\nagainst the tolerance.")
                                            : tr("Each reading appears here\nagainst its command."));
    colour();
    replot(QCustomPlot::rpQueuedReplot);
}

void CalibrationPlot::hideNearest() {
    for (QCPAbstractItem* item :
         std::initializer_list<QCPAbstractItem*>{nearest_, nearestText_, nearestTitle_, nearestLead_})
        item->setVisible(false);
}

double CalibrationPlot::shown(const CalibrationReadings& of, double commanded, double measured) const {
    return kind_ == Kind::Errors ? measured - commanded - of.baseAt(commanded) : measured;
}

void CalibrationPlot::show(const CalibrationReadings& of) {
    clear();
    if (of.readings.empty()) return;
    Reach x, y;
    for (const auto& reading : of.readings) {
        x.include(reading.commanded);
        y.include(shown(of, reading.commanded, reading.measured));
        if (kind_ == Kind::Measured) continue;
        y.include(bandAt(of, reading.commanded));
        y.include(-bandAt(of, reading.commanded));
    }
    for (std::size_t k = 0; kind_ == Kind::Errors && k < of.uncertainty.size(); ++k) {
        const auto& level = of.fit->levels[k];
        y.include(shown(of, level.commanded, level.mean) + of.uncertainty[k]);
        y.include(shown(of, level.commanded, level.mean) - of.uncertainty[k]);
    }
    const AxisUnit across = axisUnit(x.magnitude(), of.unit), upward = axisUnit(y.magnitude(), of.unit);
    xAxis->setRange(rangeOf(x, across.factor));
    if (kind_ == Kind::Errors) {
        // The band continues to the plot's edges.
        for (const double edge : {xAxis->range().lower, xAxis->range().upper}) {
            const double band = bandAt(of, edge / across.factor);
            y.include(band);
            y.include(-band);
        }
        drawBand(of, across, upward);
        drawMeans(of, across, upward);
    }
    drawLine(of, across, upward);
    yAxis->setRange(rangeOf(y, upward.factor));
    drawReadings(of, across, upward);
    if (kind_ == Kind::Errors) nameNearest(of, across, upward);
    xAxis->setLabel(axisTitle(tr("Commanded %1").arg(quantityTitle(of.quantity).toLower()), across.unit));
    if (of.tolerance_pct > 0) bandTop_->setName(tr("tolerance ± %1").arg(settingText(of.tolerance_pct, "%")));
    yAxis->setLabel(axisTitle(kind_ == Kind::Measured ? tr("Measured")
                              : of.checks             ? tr("Measured − as calibrated")
                                                      : tr("Measured − commanded"),
                              upward.unit));
    for (auto* axis : {xAxis, yAxis}) {
        axis->setTickLabels(true);
        axis->setTicker(QSharedPointer<PlainTicker>::create(kTicks));
    }
    empty_->setVisible(false);
    legend->setVisible(true);
    replot(QCustomPlot::rpQueuedReplot);
}

void CalibrationPlot::drawReadings(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    for (const auto& reading : of.readings) {
        const double at = reading.commanded * across.factor,
                     value = shown(of, reading.commanded, reading.measured) * upward.factor;
        if (!std::isfinite(at) || !std::isfinite(value)) continue;
        const bool down = reading.direction == SweepDirection::Down;
        const double aside = kind_ == Kind::Errors ? (down ? kAside : -kAside) * xAxis->range().size() : 0;
        (down ? down_ : up_)->addData(at + aside, value);
        if (reading.outlier) marked_->addData(at + aside, value);
    }
}

void CalibrationPlot::drawLine(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    if (!of.fit) return;
    for (const auto* level : {&of.fit->levels.front(), &of.fit->levels.back()}) {
        const double at = level->commanded;
        const double fitted = of.fit->gain * at + of.fit->offset;
        if (kind_ == Kind::Errors)
            nominal_->addData(at * across.factor, shown(of, at, fitted) * upward.factor);
        else
            line_->addData(at * across.factor, fitted * upward.factor);
    }
}

void CalibrationPlot::drawBand(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    if (!(of.tolerance_pct > 0)) return;
    const auto range = xAxis->range();
    QVector<double> at{range.lower, range.upper};
    if (range.contains(0)) at.insert(1, 0);  // the band is narrowest at zero
    for (const double command : at) {
        const double band = bandAt(of, command / across.factor) * upward.factor;
        bandTop_->addData(command, band);
        bandBottom_->addData(command, -band);
    }
}

void CalibrationPlot::drawMeans(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    QVector<double> u;
    for (std::size_t k = 0; k < of.uncertainty.size(); ++k) {
        const auto& level = of.fit->levels[k];
        if (!std::isfinite(level.mean)) continue;
        means_->addData(level.commanded * across.factor, shown(of, level.commanded, level.mean) * upward.factor);
        u << (std::isfinite(of.uncertainty[k]) ? of.uncertainty[k] * upward.factor : 0);
    }
    bars_->setData(u);
}

void CalibrationPlot::nameNearest(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    const auto* use = of.nearest();
    if (use == nullptr) return;
    const double at = use->commanded * across.factor, half = kNearest * xAxis->range().size();
    const double band = use->tolerance * upward.factor;
    nearest_->topLeft->setCoords(at - half, band);
    nearest_->bottomRight->setCoords(at + half, -band);
    nearest_->setVisible(true);
    nearestText_->setText(tr("%1: %2 of ± %3, %4 used")
                              .arg(settingText(use->commanded, of.unit),
                                   uncertainText(use->error, use->expanded, of.unit),
                                   settingText(use->tolerance, of.unit), limitShareText(100 * use->share())));
    // Placed below the frame, on the side with more room.
    const bool left = at < xAxis->range().center();
    const auto side = left ? Qt::AlignLeft : Qt::AlignRight;
    nearestText_->setPositionAlignment(side | Qt::AlignBottom);
    nearestText_->position->setTypeX(QCPItemPosition::ptPlotCoords);
    nearestText_->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
    nearestText_->position->setCoords(at + (left ? -half : half), kNearestBottom);
    nearestText_->setVisible(true);
    nearestTitle_->setPositionAlignment(side | Qt::AlignBottom);
    nearestTitle_->position->setParentAnchor(left ? nearestText_->topLeft : nearestText_->topRight);
    nearestTitle_->setVisible(true);
    // If the frame reaches down to the words, no line to them is needed.
    nearestLead_->setVisible((yAxis->range().upper + band) / yAxis->range().size() < kLeadFrom);
}

void CalibrationPlot::colour() {
    stylePlot(*this);
    const auto& c = colours();
    const double size = QFontMetricsF(QApplication::font()).height() / 2.4;
    const auto points = [&](QCPGraph* graph, QCPScatterStyle::ScatterShape shape, const QColor& ink, double scale,
                            bool filled) {
        graph->setPen(QPen(ink));
        graph->setScatterStyle({shape, QPen(ink, 1.4), filled ? QBrush(ink) : QBrush(Qt::NoBrush), size * scale});
    };
    points(up_, QCPScatterStyle::ssTriangle, c.voltage, 1, false);
    points(down_, QCPScatterStyle::ssTriangleInverted, c.third, 1, false);
    points(marked_, QCPScatterStyle::ssCross, c.amber, 1.8, false);
    points(means_, QCPScatterStyle::ssDisc, c.text, 0.7, true);
    bars_->setPen(QPen(c.text, 1));
    line_->setPen(QPen(c.quiet, 1));
    nominal_->setPen(QPen(c.text, 1, Qt::DotLine));
    QPen edge(c.passText, 1.5, Qt::CustomDashLine);
    edge.setDashPattern({8 / 1.5, 4 / 1.5});
    for (auto* side : {bandTop_, bandBottom_}) side->setPen(edge);
    bandTop_->setBrush(c.passCell);
    nearest_->setPen(QPen(c.text, 1));
    nearestLead_->setPen(QPen(c.text, 1));
    for (auto* words : {nearestText_, nearestTitle_}) words->setColor(c.text);
    nearestText_->setFont(textFont(TextSize::Small));
    nearestTitle_->setFont(textFont(TextSize::Small, QFont::DemiBold));
    empty_->setColor(c.quiet);
    empty_->setFont(QApplication::font());
    legend->setTextColor(c.text);
    legend->setBrush(Qt::NoBrush);
    legend->setBorderPen(Qt::NoPen);
    legend->setFont(textFont(TextSize::Small));
}

}  // namespace tacto::gui

#include "moc_CalibrationPlot.cpp"
