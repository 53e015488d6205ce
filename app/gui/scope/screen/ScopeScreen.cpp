#include "app/gui/scope/screen/ScopeScreen.h"

#include <algorithm>
#include <cmath>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/theme/Theme.h"
#include "app/report/ShownText.h"

namespace tacto::gui {

namespace {

/// The range of values shown in the lane, in the lane's unit.
std::optional<std::pair<double, double>> shownRange(const ScopeLane& lane) {
    const auto its = lane.envelope();
    if (its.empty()) return std::nullopt;
    return std::pair(static_cast<double>(its.low), static_cast<double>(its.high));
}

constexpr double kHeld = 0.55;  // share of background colour in a held trace

QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto part = [share](int x, int y) { return static_cast<int>(std::lround(x + (y - x) * share)); };
    return {part(a.red(), b.red()), part(a.green(), b.green()), part(a.blue(), b.blue())};
}

}  // namespace

ScopeScreen::ScopeScreen(const ScopeModel& model, QWidget* parent)
    : QCustomPlot(parent),
      model_(model),
      timeTicker_(new RoundTicker(kDivisionsAcross)),
      leftTicker_(new RoundTicker(kDivisionsUp)),
      rightTicker_(new RoundTicker(kDivisionsUp)) {
    setAccessibleName(tr("Oscilloscope screen"));
    // Not a tool tip, which would cover the traces wherever the mouse rests.
    setWhatsThis(
        tr("Wheel: time. Ctrl+wheel: level of the active lane. Drag: pan. Shift+drag: zoom into a box. Double "
           "click or Home: fit to the pulse, once more to the whole record. Ctrl+Z: back. Arrows: nudge the focused "
           "cursor, or pan. 1 to 4: choose a cursor. + and -: zoom. Between two edges the mouse shows width and "
           "interval."));
    setAccessibleDescription(whatsThis());
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setNoAntialiasingOnDrag(true);
    setNotAntialiasedElements(QCP::aeAll);
    addLayer("behind", layer("grid"), QCustomPlot::limAbove);
    watermark_ = addWatermark(*axisRect());
    ground_ = new RecordGround(xAxis);
    overlay_ = new ScopeOverlay(xAxis, yAxis);
    xAxis->setTicker(timeTicker_);
    yAxis->setTicker(leftTicker_);
    yAxis2->setTicker(rightTicker_);
    for (auto* axis : {yAxis, yAxis2}) {
        axis->setRange(-kHalfUp, kHalfUp);
        axis->setSubTicks(false);
    }
    xAxis->setSubTicks(false);
    yAxis2->setVisible(true);
    xAxis2->setVisible(true);
    xAxis2->setTicks(false);
    xAxis2->setTickLabels(false);
    connect(&model_, &ScopeModel::tracesChanged, this, &ScopeScreen::takeTraces);
    connect(&model_, &ScopeModel::viewChanged, this, &ScopeScreen::apply);
    connect(&model_, &ScopeModel::overlayChanged, this, &ScopeScreen::refreshOverlay);
    connect(&model_, &ScopeModel::heldChanged, this, [this] {
        restyle();
        apply();
    });
    takeTraces();
    restyle();
    apply();
    onLookChange(*this, [this] {
        restyle();
        apply();
    });
}

double ScopeScreen::timeAt(double x) const {
    return model_.viewport().left_s + (x - axisRect()->left()) * secondsPerPixel();
}

double ScopeScreen::heightAt(double y) const { return kHalfUp - (y - axisRect()->top()) * divisionsPerPixel(); }

double ScopeScreen::secondsPerPixel() const { return model_.viewport().width_s() / std::max(1, axisRect()->width()); }

double ScopeScreen::divisionsPerPixel() const { return double(kDivisionsUp) / std::max(1, axisRect()->height()); }

void ScopeScreen::setBox(const std::optional<QRectF>& box) {
    box_ = box;
    refreshOverlay();
}

const EnvelopeGraph* ScopeScreen::graph(const QString& lane) const {
    const auto found = graphs_.find(lane);
    return found == graphs_.end() ? nullptr : found->second.newest;
}

void ScopeScreen::takeTraces() {
    bool others = false;
    std::erase_if(graphs_, [&](const auto& entry) {
        const auto& [key, graphs] = entry;
        if (model_.lane(key) != nullptr) return false;
        for (auto* graph : graphs.behind) removePlottable(graph);
        removePlottable(graphs.newest);
        return true;
    });
    std::vector<std::pair<double, double>> records;
    for (const auto& lane : model_.lanes()) {
        auto& graphs = graphs_[lane.key];
        if (graphs.newest == nullptr) {
            graphs.newest = new EnvelopeGraph(xAxis, yAxis);
            if (lane.reference()) graphs.newest->setLayer("behind");
            others = true;
        }
        graphs.newest->setSpans(lane.spans);
        others = others || graphs.behind.size() != lane.behind.size();
        while (graphs.behind.size() > lane.behind.size()) {
            removePlottable(graphs.behind.back());
            graphs.behind.pop_back();
        }
        while (graphs.behind.size() < lane.behind.size()) {
            auto* graph = new EnvelopeGraph(xAxis, yAxis);
            graph->setLayer("behind");
            graph->setMarked(false);
            graphs.behind.push_back(graph);
        }
        for (std::size_t i = 0; i < lane.behind.size(); ++i) {
            const auto& span = lane.behind[i];
            graphs.behind[i]->setSpans(span.trace ? std::vector<TraceSpan>{span} : std::vector<TraceSpan>{});
        }
        if (!records.empty() || lane.reference()) continue;
        for (const auto& span : lane.spans) records.emplace_back(span.key_s, span.key_s + span.length_s());
    }
    ground_->setRecords(std::move(records));
    watermark_->setVisible(model_.shown() && model_.shown()->capture->simulated);
    if (others) restyle();
}

void ScopeScreen::restyle() {
    const auto& c = colours();
    stylePlot(*this);
    setMinimumSize(fontMetrics().averageCharWidth() * 40, fontMetrics().height() * 8);
    ground_->setColour(c.grid);
    for (auto* axis : {xAxis, yAxis, xAxis2, yAxis2}) {
        axis->setBasePen(QPen(hasFocus() ? c.text : c.quiet, 1));
        axis->setTickPen(Qt::NoPen);
        axis->grid()->setZeroLinePen(Qt::NoPen);
        axis->setTickLabelPadding(4);
    }
    for (auto* axis : {xAxis, yAxis}) axis->grid()->setVisible(true);
    for (auto* axis : {xAxis2, yAxis2}) axis->grid()->setVisible(false);
    const QFontMetrics small(xAxis->tickLabelFont());
    // Room for the numbers of all usual scales, so that the screen keeps its size when they change. Longer numbers make
    // the margin wider.
    const int side = small.horizontalAdvance("−0000") + small.height() + 12;
    const int above = small.height() / 2 + 1 + (alarm_.isEmpty() ? 0 : ScopeOverlay::alarmHeight());
    axisRect()->setMinimumMargins(QMargins(side, above, side, small.height() * 2 + 6));
    for (auto* band : bands_) band->setColours(c.passCell, c.passText);
    for (const auto& lane : model_.lanes()) {
        const auto& graphs = graphs_[lane.key];
        const auto colour = laneColour(model_, lane);
        graphs.newest->setPen(QPen(model_.held() ? mixed(colour, c.base, kHeld) : colour, 1));
        graphs.newest->setClipColour(c.amber);
        for (std::size_t i = 0; i < graphs.behind.size(); ++i) {
            const double age = 1 - static_cast<double>(i + 1) / static_cast<double>(graphs.behind.size() + 1);
            graphs.behind[i]->setPen(QPen(mixed(colour, c.base, 0.5 + 0.35 * age), 1));
        }
    }
}

void ScopeScreen::focusInEvent(QFocusEvent* event) {
    QCustomPlot::focusInEvent(event);
    restyle();
    apply();
}

void ScopeScreen::focusOutEvent(QFocusEvent* event) {
    QCustomPlot::focusOutEvent(event);
    restyle();
    apply();
}

void ScopeScreen::resizeEvent(QResizeEvent* event) {
    QCustomPlot::resizeEvent(event);
    applyAxes();
}

void ScopeScreen::apply() {
    for (const auto& lane : model_.lanes()) {
        const auto scale = model_.scaleOf(lane);
        auto& graphs = graphs_[lane.key];
        const auto place = [&](EnvelopeGraph& graph) {
            graph.setVisible(lane.shown);
            graph.setScale(scale.perDivision, scale.position);
        };
        place(*graphs.newest);
        for (auto* graph : graphs.behind) place(*graph);
    }
    for (auto* band : bands_) {
        const auto* lane = model_.lane(band->lane());
        band->setVisible(lane != nullptr && lane->shown && !model_.roll());
        if (lane == nullptr) continue;
        const auto scale = model_.scaleOf(*lane);
        band->setScale(scale.perDivision, scale.position);
    }
    applyAxes();
    fillOverlay();
    replot(QCustomPlot::rpQueuedReplot);
}

void ScopeScreen::applyAxes() {
    const auto& view = model_.viewport();
    xAxis->setRange(view.left_s, view.right_s());
    const auto time = axisUnit(view.width_s() / 2, "s");
    timeTicker_->setQuantity(0, 1, time.factor);
    // Computed from the widget's size, because the axes still have the size of the last drawing.
    const auto edges = axisRect()->minimumMargins();
    const QFontMetrics small(xAxis->tickLabelFont());
    const double perPixel = view.width_s() / std::max(1, width() - edges.left() - edges.right());
    timeTicker_->setLeast(0);
    // A wider step changes the numbers. Two rounds are enough, because the numbers do not grow longer.
    for (int i = 0; i < 2; ++i) {
        timeTicker_->setLeast(small.horizontalAdvance(timeTicker_->widestIn(xAxis->range()) + "  ") * perPixel);
    }
    const double up = double(kDivisionsUp) / std::max(1, height() - edges.top() - edges.bottom());
    for (const auto& ticker : {leftTicker_, rightTicker_}) ticker->setLeast(small.height() * up);
    const auto& shown = model_.shown();
    xAxis->setLabel((model_.roll()                                        ? tr("Session time (%1)")
                     : shown && !std::isfinite(shown->capture->trigger_s) ? tr("Time from the record's begin (%1)")
                                                                          : tr("Time from the trigger (%1)"))
                        .arg(time.unit));
    // Left axis: the first lane shown. Right axis: the active lane, or the second one shown.
    const ScopeLane *left = nullptr, *right = nullptr;
    for (const auto& lane : model_.lanes()) {
        if (!lane.shown || lane.reference()) continue;
        if (left == nullptr) {
            left = &lane;
        } else if (right == nullptr || lane.key == model_.activeLane()) {
            right = &lane;
        }
    }
    numberAxis(*yAxis, *leftTicker_, left, right != nullptr);
    numberAxis(*yAxis2, *rightTicker_, right, true);
}

void ScopeScreen::numberAxis(QCPAxis& axis, RoundTicker& ticker, const ScopeLane* lane, bool shared) const {
    ticker.setBlank(lane == nullptr);
    ticker.setNumbered(shared && lane != nullptr ? shownRange(*lane) : std::nullopt);
    axis.setLabel(QString());
    if (lane == nullptr) return;
    const auto scale = model_.scaleOf(*lane);
    const auto unit = axisUnit(scale.perDivision * kHalfUp, lane->unit);
    ticker.setQuantity(scale.position, scale.perDivision, unit.factor);
    axis.setLabel(axisTitle(lane->title, unit.unit));
    axis.setLabelColor(laneInk(model_, *lane));
    axis.setTickLabelColor(laneInk(model_, *lane));
}

void ScopeScreen::setMask(const std::shared_ptr<const CaptureMask>& mask) {
    for (auto* band : bands_) removePlottable(band);
    bands_.clear();
    mask_ = mask;
    for (std::size_t c = 0; mask_ && c < mask_->channels().size(); ++c) {
        bands_.push_back(new MaskGraph(xAxis, yAxis, *mask_, c));
        bands_.back()->setLayer("behind");
    }
    restyle();
    apply();
}

void ScopeScreen::setAlarm(const QString& alarm) {
    const bool there = !alarm_.isEmpty();
    if (std::exchange(alarm_, alarm) == alarm) return;
    if (there == !alarm_.isEmpty()) return refreshOverlay();
    restyle();
    apply();
}

void ScopeScreen::fillOverlay() {
    overlay_->state = overlayOf(model_);
    overlay_->state.alarm = alarm_;
    overlay_->state.box = box_;
}

void ScopeScreen::refreshOverlay() {
    fillOverlay();
    overlay_->layer()->replot();
}

}  // namespace tacto::gui

#include "moc_ScopeScreen.cpp"
