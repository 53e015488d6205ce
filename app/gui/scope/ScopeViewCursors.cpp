// Cursors of the oscilloscope's screen: where they stand, what they snap to, what they read; keys; the width under the
// mouse.
#include <algorithm>
#include <cmath>

#include "app/gui/scope/ScopeView.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kSnap = 8;  ///< pixels

/// The spans of a lane at whose edges cursors stop; without edges of its own, the first lane's that has some.
template <class Lanes>
const EnvelopeGraph* graphWithEdges(const Lanes& lanes, const QString& active) {
    const EnvelopeGraph* first = nullptr;
    for (const auto& l : lanes) {
        const auto& spans = l->graph->spans();
        const bool has = std::any_of(spans.begin(), spans.end(), [](const auto& s) { return !s.trace->edges.empty(); });
        if (!has) continue;
        if (l->key == active) return l->graph;
        if (first == nullptr && l->shown) first = l->graph;
    }
    return first;
}

}  // namespace

void ScopeView::setTimeCursors(bool on) {
    if (on == timeCursors_.has_value()) return;
    if (on) {
        timeCursors_ = {view_.left_s + view_.width_s() * 0.3, view_.left_s + view_.width_s() * 0.7};
        focusedCursor_ = 0;
    } else {
        timeCursors_.reset();
        if (focusedCursor_ < 2) focusedCursor_ = levelCursors_ ? 2 : -1;
    }
    emit cursorsChanged();
    refreshOverlay();
}

void ScopeView::setLevelCursors(bool on) {
    const auto* active = lane(active_);
    if (on == levelCursors_.has_value() || (on && active == nullptr)) return;
    if (on) {
        const auto scale = scaleOf(*active);
        constexpr double kEdge = kDivisionsUp / 2.0 - 0.5;
        levelCursors_ = {(std::max(-kEdge, scale.position - 1) - scale.position) * scale.perDivision,
                         (std::min(kEdge, scale.position + 1) - scale.position) * scale.perDivision};
        focusedCursor_ = 2;
    } else {
        levelCursors_.reset();
        if (focusedCursor_ >= 2) focusedCursor_ = timeCursors_ ? 0 : -1;
    }
    emit cursorsChanged();
    refreshOverlay();
}

void ScopeView::focusCursor(int cursor) {
    const bool there = cursor < 2 ? timeCursors_.has_value() : levelCursors_.has_value();
    if (!there || cursor < 0 || cursor > 3) return;
    focusedCursor_ = cursor;
    refreshOverlay();
}

CursorReadout ScopeView::readout() const {
    CursorReadout r;
    const auto* active = lane(active_);
    if (active == nullptr) return r;
    r.unit = active->unit;
    if (timeCursors_) {
        r.x1_s = (*timeCursors_)[0];
        r.x2_s = (*timeCursors_)[1];
        for (const auto& span : active->graph->spans()) {
            const double shift = span.trace->start_s - span.key_s;
            const double a = span.trace->valueAt(r.x1_s + shift), b = span.trace->valueAt(r.x2_s + shift);
            if (!std::isnan(a)) r.at1 = a;
            if (!std::isnan(b)) r.at2 = b;
        }
    }
    if (levelCursors_) {
        r.y1 = (*levelCursors_)[0];
        r.y2 = (*levelCursors_)[1];
    }
    return r;
}

double ScopeView::snappedTime(double time_s) const {
    const auto* graph = graphWithEdges(lanes_, active_);
    if (graph == nullptr) return time_s;
    double best = time_s, distance = kSnap * pixelTime();
    for (const auto& span : graph->spans()) {
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& edge : span.trace->edges) {
            for (const double at : {edge.onset_s + shift, edge.end_s + shift}) {
                if (std::abs(at - time_s) >= distance) continue;
                distance = std::abs(at - time_s);
                best = at;
            }
        }
    }
    return best;
}

double ScopeView::snappedLevel(double level) const {
    const auto* active = lane(active_);
    const auto its = trace(active_);
    if (active == nullptr || !its) return level;
    double best = level;
    double distance = kSnap * scaleOf(*active).perDivision * kDivisionsUp / std::max(1, axisRect()->height());
    for (const double rest : its->levels) {
        if (std::abs(rest - level) >= distance) continue;
        distance = std::abs(rest - level);
        best = rest;
    }
    return best;
}

std::optional<OverlayState::Hover> ScopeView::hoverAt(double time_s) const {
    const auto* graph = graphWithEdges(lanes_, active_);
    if (graph == nullptr) return {};
    for (const auto& span : graph->spans()) {
        const auto& edges = span.trace->edges;
        const double shift = span.key_s - span.trace->start_s;
        const double t = time_s - shift;
        if (edges.empty() || t < edges.front().onset_s || t > edges.back().end_s) continue;
        // The two edges around the mouse: of one phase, or the rest between two.
        const auto after = std::upper_bound(edges.begin(), edges.end(), t,
                                            [](double at, const PhaseEdges& e) { return at < e.onset_s; });
        const auto& phase = *std::prev(after);
        const bool inside = t <= phase.end_s;
        if (!inside && after == edges.end()) continue;
        OverlayState::Hover h;
        h.from_s = (inside ? phase.onset_s : phase.end_s) + shift;
        h.to_s = (inside ? phase.end_s : after->onset_s) + shift;
        h.text = (inside ? tr("Width %1") : tr("Rest %1")).arg(quantityText(h.to_s - h.from_s, "s"));
        // From the leading edge before the mouse to the next one.
        auto before = std::prev(after);
        while (before != edges.begin() && !before->leading) --before;
        const auto next = std::find_if(after, edges.end(), [](const PhaseEdges& e) { return e.leading; });
        if (next != edges.end() && before->leading) {
            const double interval = next->onset_s - before->onset_s;
            h.text += tr(" · interval %1 (%2)").arg(quantityText(interval, "s"), quantityText(1 / interval, "Hz"));
        }
        return h;
    }
    return {};
}

void ScopeView::keyPressEvent(QKeyEvent* event) {
    const auto modifiers = event->modifiers();
    const bool control = modifiers.testFlag(Qt::ControlModifier);
    if (event->matches(QKeySequence::Undo)) {
        undoZoom();
        return;
    }
    switch (event->key()) {
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
            return nudge(event->key(), modifiers);
        case Qt::Key_Plus:
        case Qt::Key_Equal:
        case Qt::Key_Minus: {
            const int steps = event->key() == Qt::Key_Minus ? 1 : -1;
            if (!control) {
                const double anchor = timeCursors_ && focusedCursor_ >= 0 && focusedCursor_ < 2
                                          ? (*timeCursors_)[static_cast<std::size_t>(focusedCursor_)]
                                          : view_.left_s + view_.width_s() / 2;
                return go(zoomedInTime(view_, steps, anchor), "time keys");
            }
            if (const auto* active = lane(active_); active != nullptr && !active->stored) {
                auto next = view_;
                next.lanes[active_] = zoomedInLevel(scaleOf(*active), steps, scaleOf(*active).position);
                go(next, "level keys");
            }
            return;
        }
        case Qt::Key_Home:
            return fit();
        case Qt::Key_1:
        case Qt::Key_2:
        case Qt::Key_3:
        case Qt::Key_4:
            if (control) break;
            return focusCursor(event->key() - Qt::Key_1);
        default:
            break;
    }
    QCustomPlot::keyPressEvent(event);
}

void ScopeView::nudge(int key, Qt::KeyboardModifiers modifiers) {
    const bool across = key == Qt::Key_Left || key == Qt::Key_Right;
    const double sign = key == Qt::Key_Right || key == Qt::Key_Up ? 1 : -1;
    const double pixels = modifiers.testFlag(Qt::ShiftModifier) ? 10 : 1;
    if (focusedCursor_ >= 0 && across == (focusedCursor_ < 2)) {
        if (across && timeCursors_) {
            auto& at = (*timeCursors_)[static_cast<std::size_t>(focusedCursor_)];
            at = modifiers.testFlag(Qt::ControlModifier) ? nextEdge(at, sign) : at + sign * pixels * pixelTime();
            hover_ = hoverAt(at);  // as under the mouse
        } else if (const auto* active = lane(active_); !across && levelCursors_ && active != nullptr) {
            (*levelCursors_)[static_cast<std::size_t>(focusedCursor_ - 2)] +=
                sign * pixels * scaleOf(*active).perDivision * kDivisionsUp / std::max(1, axisRect()->height());
        }
        emit cursorsChanged();
        return refreshOverlay();
    }
    auto before = view_;
    panBy(across ? sign * view_.perDivision_s / 5 : 0, across ? 0 : -sign / 5);
    history_.remember(before, "pan keys");
    apply();
}

double ScopeView::nextEdge(double time_s, double direction) const {
    const auto* graph = graphWithEdges(lanes_, active_);
    if (graph == nullptr) return time_s;
    double best = time_s, distance = std::numeric_limits<double>::infinity();
    const double least = view_.width_s() * 1e-9;  // an edge that it stands on is not the next one
    for (const auto& span : graph->spans()) {
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& edge : span.trace->edges) {
            for (const double at : {edge.onset_s + shift, edge.end_s + shift}) {
                const double away = (at - time_s) * direction;
                if (away <= least || away >= distance) continue;
                distance = away;
                best = at;
            }
        }
    }
    return best;
}

void ScopeView::setTrigger(const QString& key, double level, bool held) {
    if (triggerLane_ == key && triggerLevel_ == level && triggerHeld_ == held) return;
    if (drag_ == Drag::Grip && grip_.grip == Grip::TriggerLevel && !held) return;  // the hand on it knows better
    triggerLane_ = key;
    triggerLevel_ = level;
    triggerHeld_ = held;
    refreshOverlay();
}

void ScopeView::setPreTrigger(std::optional<double> fraction) { preTrigger_ = fraction; }

}  // namespace tacto::gui
