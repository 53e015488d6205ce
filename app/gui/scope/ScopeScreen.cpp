#include "app/gui/scope/ScopeScreen.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kHeld = 0.55;  // so much of the ground is in a trace that is held

QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto part = [share](int x, int y) { return static_cast<int>(std::lround(x + (y - x) * share)); };
    return {part(a.red(), b.red()), part(a.green(), b.green()), part(a.blue(), b.blue())};
}

}  // namespace

QColor laneColour(const ScopeModel& model, const ScopeLane& lane) {
    const auto& c = colours();
    if (lane.reference()) return c.zero;
    const bool dark = currentTheme() == Theme::Dark;
    if (lane.key == "math/power") return c.third;
    if (lane.key == "math/charge") return dark ? c.third.lighter(125) : c.third.darker(140);
    if (lane.key == "math/difference") return c.text;
    if (lane.letter == "V" || lane.letter == "V1") return c.voltage;
    if (lane.letter == "I" || lane.letter == "I1") return c.current;
    // Further channels of an unusual instrument: the palette's others, in the order they come.
    const auto& all = model.lanes();
    const auto at = std::find_if(all.begin(), all.end(), [&](const ScopeLane& l) { return l.key == lane.key; });
    return conditionInTheme({}, static_cast<int>(at - all.begin())).color;
}

QColor laneInk(const ScopeModel& model, const ScopeLane& lane) {
    const auto& c = colours();
    const auto colour = laneColour(model, lane);
    return colour == c.current ? c.currentText : legible(colour, c.base);
}

ScopeScreen::ScopeScreen(const ScopeModel& model, QWidget* parent)
    : QCustomPlot(parent),
      model_(model),
      timeTicker_(new RoundTicker(kDivisionsAcross)),
      leftTicker_(new RoundTicker(kDivisionsUp)),
      rightTicker_(new RoundTicker(kDivisionsUp)) {
    setAccessibleName(tr("Oscilloscope screen"));
    // Not a tool tip: it would lie over the traces wherever the mouse rests.
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
    // Room for the widest numbers, so that the screen does not jump while they change.
    const int side = small.horizontalAdvance("−000.00") + small.height() + 12;
    axisRect()->setMinimumMargins(QMargins(side, small.height() / 2 + 5, side, small.height() * 2 + 12));
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
    // From the widget's size: the axes' own is that of the last drawing.
    const auto edges = axisRect()->minimumMargins();
    const QFontMetrics small(xAxis->tickLabelFont());
    const double perPixel = view.width_s() / std::max(1, width() - edges.left() - edges.right());
    timeTicker_->setLeast(0);
    // A wider step has other numbers: twice is enough, they do not grow longer.
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
    // Left: the first lane that is shown. Right: the active one, or the second.
    const ScopeLane *left = nullptr, *right = nullptr;
    for (const auto& lane : model_.lanes()) {
        if (!lane.shown || lane.reference()) continue;
        if (left == nullptr) {
            left = &lane;
        } else if (right == nullptr || lane.key == model_.activeLane()) {
            right = &lane;
        }
    }
    numberAxis(*yAxis, *leftTicker_, left);
    numberAxis(*yAxis2, *rightTicker_, right);
}

void ScopeScreen::numberAxis(QCPAxis& axis, RoundTicker& ticker, const ScopeLane* lane) const {
    ticker.setBlank(lane == nullptr);
    axis.setLabel(QString());
    if (lane == nullptr) return;
    const auto scale = model_.scaleOf(*lane);
    const auto unit = axisUnit(scale.perDivision * kHalfUp, lane->unit);
    ticker.setQuantity(scale.position, scale.perDivision, unit.factor);
    axis.setLabel(unit.unit.isEmpty() ? lane->title : tr("%1 (%2)").arg(lane->title, unit.unit));
    axis.setLabelColor(laneInk(model_, *lane));
    axis.setTickLabelColor(laneInk(model_, *lane));
}

void ScopeScreen::fillOverlay() {
    auto& o = overlay_->state;
    o = {};
    for (const auto& lane : model_.lanes()) {
        if (lane.reference() || !lane.shown) continue;
        o.lanes.push_back({lane.key, lane.letter, laneInk(model_, lane), model_.scaleOf(lane).position,
                           lane.key == model_.activeLane()});
    }
    fillTrigger(o);
    fillCursors(o);
    if (model_.shown() && model_.shown()->capture->untriggered) o.notes << tr("not triggered");
    if (model_.held()) o.notes << tr("the last live train, held");
    if (model_.shown() && model_.shown()->averaged > 0) o.notes << tr("averaged %1").arg(model_.shown()->averaged);
    if (const auto mark = model_.markBeside(); !mark.isEmpty()) o.notes << mark;
    for (const auto& mark : model_.marksOnAxis()) o.moments.push_back({mark.at_s, mark.word});
    o.alarm = alarm_;
    o.box = box_;
    o.hover = model_.hovered();
    fillMarks(o);
}

void ScopeScreen::fillCursors(OverlayState& o) const {
    const auto& cursors = model_.cursors();
    const auto read = model_.readout();
    const double rate_hz = model_.shown() ? model_.shown()->capture->rate_hz : 0;
    o.focusedCursor = cursors.focused();
    if (const auto& times = cursors.time_s()) {
        o.timeCursors_s.assign(times->begin(), times->end());
        o.timeSpan = spanText(read, rate_hz);
        for (const auto& [name, time_s] : {std::pair(tr("t₁"), read.x1_s), std::pair(tr("t₂"), read.x2_s)}) {
            o.flags.push_back({name, quantityText(knownTime(time_s, rate_hz), "s"), {}});
        }
        for (const auto& value : model_.cursorValues()) {
            const auto& lane = *model_.lane(value.lane);
            for (std::size_t i = 0; i < 2; ++i) {
                const auto& at = value.at[i];
                auto text = levelText(at.value, lane.unit);
                if (at.slope != 0) text += at.slope > 0 ? QStringLiteral(" ↑") : QStringLiteral(" ↓");
                o.flags[i].rows.push_back({lane.letter, text, laneInk(model_, lane)});
            }
        }
    }
    if (cursors.time_s()) fillDrawn(o);
    const auto* active = model_.lane(model_.activeLane());
    if (active == nullptr || !cursors.level()) return;
    for (const double level : *cursors.level()) {
        o.levelCursors.push_back(model_.scaleOf(*active).heightOf(level));
        o.levelTexts.push_back((o.levelTexts.empty() ? tr("y₁ %1") : tr("y₂ %1")).arg(levelText(level, active->unit)));
    }
    o.levelSpan = tr("Δ %1").arg(levelText(read.dy(), active->unit));
}

void ScopeScreen::fillDrawn(OverlayState& o) const {
    constexpr int kColumns = 300;
    const auto& view = model_.viewport();
    const double column_s = view.width_s() / kColumns;
    for (const auto& lane : model_.lanes()) {
        if (!lane.shown || lane.reference() || lane.spans.empty()) continue;
        const auto scale = model_.scaleOf(lane);
        const auto& span = lane.spans.back();
        const auto& trace = *span.trace;
        const auto sample = [&](double time_s) {
            return static_cast<std::size_t>(
                std::clamp((time_s - span.key_s) * trace.rate_hz, 0.0, static_cast<double>(trace.size())));
        };
        for (int column = 0; column < kColumns; ++column) {
            const double from_s = view.left_s + column * column_s, to_s = from_s + column_s;
            if (to_s < span.key_s || from_s > span.key_s + span.length_s()) continue;
            // One more either way: the line to it is drawn as well.
            const auto its = trace.pyramid.over(sample(from_s), std::min(sample(to_s) + 2, trace.size()));
            if (its.empty()) continue;
            o.drawn.push_back({from_s, to_s, scale.heightOf(static_cast<double>(its.low)),
                               scale.heightOf(static_cast<double>(its.high))});
        }
    }
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
    if (std::exchange(alarm_, alarm) != alarm) refreshOverlay();
}

void ScopeScreen::fillTrigger(OverlayState& o) const {
    const auto& trigger = model_.trigger();
    if (model_.shown() && !model_.roll() && std::isfinite(model_.shown()->capture->trigger_s)) {
        o.trigger.emplace();
        o.trigger->moment_s = trigger.moment_s().value_or(0);
        o.trigger->colour = colours().quiet;
    }
    if (const auto* source = model_.lane(trigger.lane()); source != nullptr && source->shown) {
        if (!o.trigger) o.trigger.emplace();
        o.trigger->height = model_.scaleOf(*source).heightOf(trigger.level());
        o.trigger->colour = laneInk(model_, *source);
        o.trigger->held = trigger.held();
    }
    if (o.trigger) o.trigger->text = trigger.text();
}

/// Pulses that were not measured, of the active lane or the first.
void ScopeScreen::fillMarks(OverlayState& o) const {
    if (o.lanes.empty()) return;
    const auto marked = std::find_if(o.lanes.begin(), o.lanes.end(), [](const auto& lane) { return lane.active; });
    const auto& from = marked == o.lanes.end() ? o.lanes.front() : *marked;
    const auto& view = model_.viewport();
    for (const auto& span : model_.lane(from.key)->spans) {
        if (span.key_s + span.length_s() < view.left_s || span.key_s > view.right_s()) continue;
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& mark : span.trace->marks) {
            if (mark.to_s + shift < view.left_s || mark.from_s + shift > view.right_s()) continue;
            o.marks.push_back({mark.from_s + shift, mark.to_s + shift, mark.why, from.colour});
        }
    }
}

void ScopeScreen::refreshOverlay() {
    fillOverlay();
    overlay_->layer()->replot();
}

}  // namespace tacto::gui

#include "moc_ScopeScreen.cpp"
