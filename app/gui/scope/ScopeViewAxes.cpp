// How the view stands on the screen: axes and their numbers, colours, and what the overlay shows.
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
    setMinimumSize(fontMetrics().averageCharWidth() * 40, fontMetrics().height() * 8);
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
    // From the widget's size: the axes' own is that of the last drawing.
    const auto edges = axisRect()->minimumMargins();
    const int across = (width() - edges.left() - edges.right()) / kDivisionsAcross;
    const int widest = small.horizontalAdvance("−000.00 ");
    timeTicker_->setEvery(across * 2 < widest ? 5 : across < widest ? 2 : 1);
    const int up = (height() - edges.top() - edges.bottom()) / kDivisionsUp;
    for (const auto& ticker : {leftTicker_, rightTicker_}) ticker->setEvery(up < small.height() ? 2 : 1);
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
    if (shown_ && shown_->capture->untriggered) o.note = tr("not triggered");
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
