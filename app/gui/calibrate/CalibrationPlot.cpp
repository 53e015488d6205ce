#include "app/gui/calibrate/CalibrationPlot.h"

#include "app/gui/look/Look.h"
#include "app/gui/look/PlotPicture.h"
#include "app/report/PlotSheet.h"

namespace tacto::gui {

namespace {

constexpr double kMargin = 0.06;
constexpr int kBandAlpha = 40;
constexpr int kTicks = 5;
constexpr int kEdge = 4;  // pixels around the axes
constexpr int kLeastChars = 24;
constexpr int kLeastLines = 10;
constexpr int kOneRowChars = 76;  // the legend stands in one row from this width on

/// The smallest range that holds all it was shown; NaN is passed over.
struct Reach {
    double low = std::nan("");
    double high = std::nan("");
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] bool known() const { return std::isfinite(low); }
    [[nodiscard]] double magnitude() const { return known() ? std::max(std::abs(low), std::abs(high)) : 1; }
    [[nodiscard]] QCPRange range(double factor) const {
        return known() ? padded(low * factor, high * factor, kMargin) : QCPRange(0, 1);
    }
};

double bandAt(const CalibrationReadings& of, double command) { return of.tolerance_pct / 100 * std::abs(command); }

}  // namespace

CalibrationPlot::CalibrationPlot(Kind kind, QWidget* parent) : QCustomPlot(parent), kind_(kind) {
    const bool errors = kind == Kind::Errors;
    setAccessibleName(errors ? tr("Error and tolerance") : tr("Measured against commanded"));
    setToolTip(errors ? tr("How far each reading lies from its command, inside or outside the tolerance band. A dot is "
                           "a level's mean with its uncertainty. A cross marks a reading that stands out: it is kept.")
                      : tr("Each reading against its command, with the fitted line. Triangles point the way the sweep "
                           "went. A cross marks a reading that stands out: it is kept."));
    build();
    addPlotMenu(*this, errors ? "calibration-errors" : "calibration");
    // Stated, or the legend in one row would say how narrow the window may become.
    setMinimumSize(fontMetrics().averageCharWidth() * kLeastChars, fontMetrics().height() * kLeastLines);
    clear();
}

void CalibrationPlot::build() {
    bandBottom_ = addGraph();
    bandTop_ = addGraph();
    bandTop_->setChannelFillGraph(bandBottom_);
    for (auto** graph : {&line_, &up_, &down_, &marked_, &means_}) *graph = addGraph();
    for (auto* graph : {up_, down_, marked_, means_}) graph->setLineStyle(QCPGraph::lsNone);
    bars_ = new QCPErrorBars(xAxis, yAxis);
    bars_->setDataPlottable(means_);
    bars_->setErrorType(QCPErrorBars::etValueError);
    up_->setName(tr("up"));
    down_->setName(tr("down"));
    marked_->setName(tr("stands out"));
    means_->setName(tr("mean ± U"));
    bandTop_->setName(tr("tolerance"));
    axisRect()->setMinimumMargins(QMargins(kEdge, kEdge, kEdge, kEdge));
    if (kind_ == Kind::Errors) addLegend();
    watermark_ = addWatermark(*axisRect());
    watermark_->setVisible(false);
    empty_ = new QCPItemText(this);
    empty_->position->setType(QCPItemPosition::ptAxisRectRatio);
    empty_->position->setCoords(0.5, 0.5);
    empty_->setText(kind_ == Kind::Errors ? tr("Each reading's error appears here\nagainst the tolerance.")
                                          : tr("Each reading appears here\nagainst its command."));
}

/// One for both plots, above the wider one.
void CalibrationPlot::addLegend() {
    axisRect()->insetLayout()->take(legend);
    plotLayout()->insertRow(0);
    plotLayout()->addElement(0, 0, legend);
    plotLayout()->setRowStretchFactor(0, 0.001);
    plotLayout()->setRowSpacing(0);
    legend->setMaximumSize(100000, 100000);  // else an empty one narrows the axes to nothing
    legend->setFillOrder(QCPLayoutGrid::foColumnsFirst);
    legend->clearItems();
    named_ = {up_, down_, marked_, means_, bandTop_};
    for (auto* graph : named_) graph->addToLegend();
}

void CalibrationPlot::clear() {
    for (auto* graph : {bandBottom_, bandTop_, line_, up_, down_, marked_, means_}) graph->data()->clear();
    bars_->setData(QVector<double>());
    for (auto* axis : {xAxis, yAxis}) axis->setTickLabels(false);
    xAxis->setLabel(tr("commanded"));
    yAxis->setLabel(kind_ == Kind::Errors ? tr("error") : tr("measured"));
    legend->setVisible(false);
    empty_->setVisible(true);
    colour();
    replot(QCustomPlot::rpQueuedReplot);
}

double CalibrationPlot::shown(const CalibrationReading& reading) const {
    return kind_ == Kind::Errors ? reading.measured - reading.commanded : reading.measured;
}

void CalibrationPlot::show(const CalibrationReadings& of) {
    clear();
    if (of.readings.empty()) return;
    Reach x, y;
    for (const auto& reading : of.readings) {
        x.include(reading.commanded);
        y.include(shown(reading));
        if (kind_ == Kind::Measured) continue;
        y.include(bandAt(of, reading.commanded));
        y.include(-bandAt(of, reading.commanded));
    }
    for (std::size_t k = 0; kind_ == Kind::Errors && k < of.uncertainty.size(); ++k) {
        const auto& level = of.fit->levels[k];
        y.include(level.mean - level.commanded + of.uncertainty[k]);
        y.include(level.mean - level.commanded - of.uncertainty[k]);
    }
    const AxisUnit across = axisUnit(x.magnitude(), of.unit), upward = axisUnit(y.magnitude(), of.unit);
    drawReadings(of, across, upward);
    if (kind_ == Kind::Errors) {
        drawBand(of, across, upward);
        drawMeans(of, across, upward);
    } else {
        drawLine(of, across, upward);
    }
    xAxis->setRange(x.range(across.factor));
    yAxis->setRange(y.range(upward.factor));
    xAxis->setLabel(tr("commanded (%1)").arg(across.unit));
    yAxis->setLabel(kind_ == Kind::Errors ? tr("error (%1)").arg(upward.unit) : tr("measured (%1)").arg(upward.unit));
    for (auto* axis : {xAxis, yAxis}) {
        axis->setTickLabels(true);
        axis->setTicker(QSharedPointer<PlainTicker>::create(kTicks));
    }
    empty_->setVisible(false);
    legend->setVisible(kind_ == Kind::Errors);
    replot(QCustomPlot::rpQueuedReplot);
}

void CalibrationPlot::drawReadings(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    for (const auto& reading : of.readings) {
        const double at = reading.commanded * across.factor, value = shown(reading) * upward.factor;
        if (!std::isfinite(at) || !std::isfinite(value)) continue;
        (reading.direction == SweepDirection::Down ? down_ : up_)->addData(at, value);
        if (reading.outlier) marked_->addData(at, value);
    }
}

void CalibrationPlot::drawLine(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    if (!of.fit) return;
    for (const auto* level : {&of.fit->levels.front(), &of.fit->levels.back()}) {
        const double at = level->commanded;
        line_->addData(at * across.factor, (of.fit->gain * at + of.fit->offset) * upward.factor);
    }
}

void CalibrationPlot::drawBand(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    if (!(of.tolerance_pct > 0)) return;
    for (const auto& reading : of.readings) {
        const double band = bandAt(of, reading.commanded) * upward.factor;
        bandTop_->addData(reading.commanded * across.factor, band);
        bandBottom_->addData(reading.commanded * across.factor, -band);
    }
}

void CalibrationPlot::drawMeans(const CalibrationReadings& of, const AxisUnit& across, const AxisUnit& upward) {
    QVector<double> u;
    for (std::size_t k = 0; k < of.uncertainty.size(); ++k) {
        const auto& level = of.fit->levels[k];
        if (!std::isfinite(level.mean)) continue;
        means_->addData(level.commanded * across.factor, (level.mean - level.commanded) * upward.factor);
        u << (std::isfinite(of.uncertainty[k]) ? of.uncertainty[k] * upward.factor : 0);
    }
    bars_->setData(u);
}

void CalibrationPlot::setSimulated(bool simulated) {
    if (watermark_->visible() == simulated) return;
    watermark_->setVisible(simulated);
    replot(QCustomPlot::rpQueuedReplot);
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
    points(down_, QCPScatterStyle::ssTriangleInverted, c.current, 1, false);
    points(marked_, QCPScatterStyle::ssCross, c.amber, 1.8, false);
    points(means_, QCPScatterStyle::ssDisc, c.text, 0.7, true);
    bars_->setPen(QPen(c.text, 1));
    line_->setPen(QPen(c.quiet, 1));
    auto band = c.amber;
    for (auto* edge : {bandTop_, bandBottom_}) edge->setPen(QPen(band, 1.2, Qt::DashLine));
    band.setAlpha(kBandAlpha);
    bandTop_->setBrush(band);
    empty_->setColor(c.quiet);
    empty_->setFont(QApplication::font());
    legend->setTextColor(c.text);
    legend->setBrush(QBrush(c.base));
    legend->setBorderPen(Qt::NoPen);
    legend->setFont(QApplication::font());
}

void CalibrationPlot::resizeEvent(QResizeEvent* event) {
    // Names in one row where they fit, else three in a row.
    const int wrap = width() < fontMetrics().averageCharWidth() * kOneRowChars ? 3 : 0;
    if (!named_.empty() && legend->wrap() != wrap) {
        legend->setWrap(wrap);
        // A grid keeps its cells where they were: put them in anew.
        for (auto* graph : named_) graph->removeFromLegend();
        for (auto* graph : named_) graph->addToLegend();
    }
    QCustomPlot::resizeEvent(event);
}

void CalibrationPlot::changeEvent(QEvent* event) {
    if ((event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) && empty_ != nullptr) {
        colour();
        replot(QCustomPlot::rpQueuedReplot);
    }
    QCustomPlot::changeEvent(event);
}

}  // namespace tacto::gui
