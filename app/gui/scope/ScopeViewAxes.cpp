// How the view stands on the screen: axes and their numbers, colours, fitting, and what the overlay shows.
#include <algorithm>
#include <cmath>

#include "app/gui/look/Look.h"
#include "app/gui/scope/ScopeView.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kHalf = kDivisionsUp / 2.0;

QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto part = [share](int x, int y) { return static_cast<int>(std::lround(x + (y - x) * share)); };
    return {part(a.red(), b.red()), part(a.green(), b.green()), part(a.blue(), b.blue())};
}

}  // namespace

ScopeView::ScopeView(QWidget* parent)
    : QCustomPlot(parent),
      timeTicker_(new GraticuleTicker(kDivisionsAcross)),
      leftTicker_(new GraticuleTicker(kDivisionsUp)),
      rightTicker_(new GraticuleTicker(kDivisionsUp)) {
    setAccessibleName(tr("Oscilloscope screen"));
    // Not a tool tip: it would lie over the traces wherever the mouse rests.
    setWhatsThis(
        tr("Wheel: time. Ctrl+wheel: level of the active lane. Drag: pan. Shift+drag: zoom into a box. Double "
           "click or Home: fit. Ctrl+Z: back. Arrows: nudge the focused cursor, or pan. 1 to 4: choose a cursor. "
           "+ and -: zoom. Between two edges the mouse shows width and interval."));
    setAccessibleDescription(whatsThis());
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setNoAntialiasingOnDrag(true);
    setNotAntialiasedElements(QCP::aeAll);
    setMinimumSize(fontMetrics().averageCharWidth() * 40, fontMetrics().height() * 10);
    addLayer("behind", layer("grid"), QCustomPlot::limAbove);
    watermark_ = addWatermark(*axisRect());
    ground_ = new RecordGround(xAxis);
    overlay_ = new ScopeOverlay(xAxis, yAxis);
    xAxis->setTicker(timeTicker_);
    yAxis->setTicker(leftTicker_);
    yAxis2->setTicker(rightTicker_);
    for (auto* axis : {yAxis, yAxis2}) {
        axis->setRange(-kHalf, kHalf);
        axis->setSubTicks(false);
    }
    xAxis->setSubTicks(false);
    yAxis2->setVisible(true);
    xAxis2->setVisible(true);
    xAxis2->setTicks(false);
    xAxis2->setTickLabels(false);
    watermark_->setVisible(false);
    restyle();
    apply();
}

QColor ScopeView::colourOf(const Lane& lane) const {
    const auto& c = colours();
    if (lane.stored) return c.reference;
    const bool dark = currentTheme() == Theme::Dark;
    if (lane.key == "math/power") return c.math;
    if (lane.key == "math/charge") return dark ? c.math.lighter(125) : c.math.darker(140);
    if (lane.key == "math/difference") return c.text;
    if (lane.letter == "V" || lane.letter == "V1") return c.voltage;
    if (lane.letter == "I" || lane.letter == "I1") return c.current;
    // Further channels of an unusual instrument: the palette's others, in the order they come.
    int index = 0;
    for (const auto& other : lanes_) {
        if (other->key == lane.key) break;
        ++index;
    }
    return conditionLook({}, index).color;
}

void ScopeView::restyle() {
    const auto& c = colours();
    stylePlot(*this);
    ground_->setColour(c.grid);
    for (auto* axis : {xAxis, yAxis, xAxis2, yAxis2}) {
        axis->setBasePen(QPen(hasFocus() ? c.accent : c.quiet, 1));
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
    for (const auto& l : lanes_) {
        const auto colour = colourOf(*l);
        l->graph->setPen(QPen(colour, 1));
        l->graph->setClipColour(c.amber);
        for (std::size_t i = 0; i < l->behind.size(); ++i) {
            const double age = 1 - static_cast<double>(i + 1) / static_cast<double>(l->behind.size() + 1);
            l->behind[i]->setPen(QPen(mixed(colour, c.base, 0.5 + 0.35 * age), 1));
        }
    }
}

void ScopeView::changeEvent(QEvent* event) {
    QCustomPlot::changeEvent(event);
    if (event->type() != QEvent::PaletteChange && event->type() != QEvent::FontChange) return;
    restyle();
    emit lanesChanged();
    apply();
}

void ScopeView::focusInEvent(QFocusEvent* event) {
    QCustomPlot::focusInEvent(event);
    restyle();
    apply();
}

void ScopeView::focusOutEvent(QFocusEvent* event) {
    QCustomPlot::focusOutEvent(event);
    restyle();
    apply();
}

void ScopeView::resizeEvent(QResizeEvent* event) {
    QCustomPlot::resizeEvent(event);
    applyAxes();
}

void ScopeView::fitLanes(Viewport& view) const {
    std::vector<const Lane*> shown;
    for (const auto& l : lanes_) {
        if (!l->stored) shown.push_back(l.get());
    }
    // A lane that is not shown takes no room, but when it comes it must stand somewhere: in the middle.
    const auto count = static_cast<double>(
        std::max<std::ptrdiff_t>(1, std::count_if(shown.begin(), shown.end(), [](auto* l) { return l->shown; })));
    const double height = kDivisionsUp / count;
    int place = 0;
    for (const auto* l : shown) {
        const auto newest = shown_ ? shown_->trace(l->key) : nullptr;
        if (!newest) continue;
        Envelope all = newest->pyramid.over(0, newest->size());
        for (const auto& span : l->graph->spans()) {
            const auto its = span.trace->pyramid.over(0, span.trace->size());
            all.low = std::min(all.low, its.low);
            all.high = std::max(all.high, its.high);
        }
        double low = all.empty() ? 0 : static_cast<double>(all.low);
        double high = all.empty() ? 0 : static_cast<double>(all.high);
        // A flat line is not blown up to its last bit.
        const double least = newest->low < newest->high ? (newest->high - newest->low) / 50
                             : low == high              ? std::max(1e-3, std::abs(low))
                                                        : 0;
        if (high - low < least) {
            const double middle = (low + high) / 2;
            low = middle - least / 2;
            high = middle + least / 2;
        }
        const double middle = l->shown ? kHalf - (place++ + 0.5) * height : 0;
        // Lanes may touch: half a division more would often halve them.
        view.lanes[l->key] = restingLevels(low, high, middle, height * (count > 1 ? 1.08 : 0.95));
    }
}

bool ScopeView::outgrown() const {
    for (const auto& l : lanes_) {
        const auto newest = l->stored || !l->shown ? nullptr : shown_->trace(l->key);
        if (!newest) continue;
        const auto scale = scaleOf(*l);
        const auto all = newest->pyramid.over(0, newest->size());
        if (all.empty()) continue;
        if (static_cast<double>(all.high) / scale.perDivision + scale.position > kHalf ||
            static_cast<double>(all.low) / scale.perDivision + scale.position < -kHalf) {
            return true;
        }
    }
    return false;
}

void ScopeView::fitTime() {
    if (!shown_) return;
    double from = shown_->capture->start_s, to = shown_->end_s();
    if (roll_ && !older_.empty()) from = std::min(from, older_.back()->capture->start_s);
    view_ = showingTime(view_, from - zero_s(), to - zero_s());
}

void ScopeView::fit() {
    if (!shown_) return;
    const auto before = view_;
    fitTime();
    auto next = view_;
    view_ = before;
    fitLanes(next);
    go(next, {});
    untouched_ = true;
}

void ScopeView::setTimePerDivision(double perDivision_s) {
    if (!(perDivision_s > 0)) return;
    auto next = view_;
    const double centre = view_.left_s + view_.width_s() / 2;
    next.perDivision_s = perDivision_s;
    next.left_s = onGrid(centre - next.width_s() / 2, perDivision_s);
    if (roll_ && shown_) next.left_s = shown_->end_s() - next.width_s();
    go(next, "time base");
}

void ScopeView::setTimeCentre(double centre_s) {
    if (!std::isfinite(centre_s)) return;
    auto next = view_;
    next.left_s = centre_s - next.width_s() / 2;
    go(next, "time position");
}

void ScopeView::go(const Viewport& next, const QString& kind) {
    if (next == view_) return;
    history_.remember(view_, kind);
    if (next.lanes != view_.lanes) untouched_ = false;
    view_ = next;
    apply();
}

bool ScopeView::undoZoom() {
    const auto before = history_.undo();
    if (!before) return false;
    // Lanes that came since keep their scale.
    untouched_ = false;
    const auto now = view_.lanes;
    view_ = *before;
    view_.lanes.insert(now.begin(), now.end());
    apply();
    return true;
}

void ScopeView::apply() {
    for (const auto& l : lanes_) {
        const auto scale = scaleOf(*l);
        l->graph->setVisible(l->shown);
        l->graph->setScale(scale.perDivision, scale.position);
        for (auto* graph : l->behind) {
            graph->setVisible(l->shown);
            graph->setScale(scale.perDivision, scale.position);
        }
    }
    applyAxes();
    fillOverlay();
    emit viewChanged();
    replot(QCustomPlot::rpQueuedReplot);
}

void ScopeView::applyAxes() {
    xAxis->setRange(view_.left_s, view_.right_s());
    const auto time = axisUnit(view_.width_s() / 2, "s");
    timeTicker_->setQuantity(0, 1, time.factor);
    const QFontMetrics small(xAxis->tickLabelFont());
    timeTicker_->setEvery(axisRect()->width() / kDivisionsAcross < small.horizontalAdvance("−000.00 ") ? 2 : 1);
    xAxis->setLabel(roll_ ? tr("Session time (%1)").arg(time.unit) : tr("Time from the trigger (%1)").arg(time.unit));
    if (shown_ && !roll_ && !std::isfinite(shown_->capture->trigger_s)) {
        xAxis->setLabel(tr("Time from the record's begin (%1)").arg(time.unit));
    }
    // Left: the first lane that is shown. Right: the active one, or the second.
    const Lane *left = nullptr, *right = nullptr;
    for (const auto& l : lanes_) {
        if (!l->shown || l->stored) continue;
        if (left == nullptr) {
            left = l.get();
        } else if (right == nullptr || l->key == active_) {
            right = l.get();
        }
    }
    const auto number = [&](QCPAxis& axis, GraticuleTicker& ticker, const Lane* l) {
        ticker.setBlank(l == nullptr);
        axis.setLabel(QString());
        if (l == nullptr) return;
        const auto scale = scaleOf(*l);
        const auto unit = axisUnit(scale.perDivision * kHalf, l->unit);
        ticker.setQuantity(scale.position, scale.perDivision, unit.factor);
        axis.setLabel(unit.unit.isEmpty() ? l->title : tr("%1 (%2)").arg(l->title, unit.unit));
        axis.setLabelColor(colourOf(*l));
        axis.setTickLabelColor(colourOf(*l));
    };
    number(*yAxis, *leftTicker_, left);
    number(*yAxis2, *rightTicker_, right);
}

void ScopeView::fillOverlay() {
    auto& o = overlay_->state;
    o = {};
    const Lane* marked = nullptr;
    for (const auto& l : lanes_) {
        if (l->stored) continue;
        if (!l->shown) continue;
        o.lanes.push_back({l->letter, colourOf(*l), scaleOf(*l).position, l->key == active_});
        if (marked == nullptr || l->key == active_) marked = l.get();
    }
    if (shown_ && !roll_ && std::isfinite(shown_->capture->trigger_s)) {
        o.trigger.emplace();
        o.trigger->moment_s = wantedMoment_s_.value_or(0);
        o.trigger->colour = colours().quiet;
    }
    if (const auto* source = lane(triggerLane_); source != nullptr && source->shown) {
        if (!o.trigger) o.trigger.emplace();
        const auto scale = scaleOf(*source);
        o.trigger->height = triggerLevel_ / scale.perDivision + scale.position;
        o.trigger->colour = colourOf(*source);
        o.trigger->held = triggerHeld_;
    }
    if (o.trigger) o.trigger->text = triggerText_;
    if (timeCursors_) o.timeCursors_s.assign(timeCursors_->begin(), timeCursors_->end());
    if (const auto* active = lane(active_); levelCursors_ && active != nullptr) {
        const auto scale = scaleOf(*active);
        for (const double level : *levelCursors_) o.levelCursors.push_back(level / scale.perDivision + scale.position);
    }
    o.focusedCursor = focusedCursor_;
    o.box = box_;
    o.hover = hover_;
    if (marked == nullptr) return;
    for (const auto& span : marked->graph->spans()) {
        const double shift = span.key_s - span.trace->start_s;
        const double end = span.key_s + static_cast<double>(span.trace->size()) / span.trace->rate_hz;
        if (end < view_.left_s || span.key_s > view_.right_s()) continue;
        for (const auto& mark : span.trace->marks) {
            if (mark.to_s + shift < view_.left_s || mark.from_s + shift > view_.right_s()) continue;
            o.marks.push_back({mark.from_s + shift, mark.to_s + shift, mark.why, colourOf(*marked)});
        }
    }
}

void ScopeView::refreshOverlay() {
    fillOverlay();
    overlay_->layer()->replot();
}

}  // namespace tacto::gui
