// Mouse and keys of the oscilloscope's screen: zoom, pan, box, handles.
#include <algorithm>
#include <cmath>

#include "app/gui/scope/ScopeView.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kStillAClick = 3;  ///< pixels

Qt::CursorShape shapeFor(Grip grip, bool held) {
    switch (grip) {
        case Grip::Lane:
        case Grip::LevelCursor:
            return Qt::SizeVerCursor;
        case Grip::TriggerLevel:
            return held ? Qt::ForbiddenCursor : Qt::SizeVerCursor;
        case Grip::TriggerMoment:
        case Grip::TimeCursor:
            return Qt::SizeHorCursor;
        case Grip::None:
            break;
    }
    return Qt::ArrowCursor;
}

}  // namespace

double ScopeView::timeAt(double x) const {
    const auto* rect = axisRect();
    return view_.left_s + (x - rect->left()) / std::max(1, rect->width()) * view_.width_s();
}

double ScopeView::heightAt(double y) const {
    const auto* rect = axisRect();
    return kDivisionsUp * (0.5 - (y - rect->top()) / std::max(1, rect->height()));
}

double ScopeView::pixelTime() const { return view_.width_s() / std::max(1, axisRect()->width()); }

ScopeView::Lane* ScopeView::gripLane(int number) {
    for (const auto& l : lanes_) {
        if (!l->stored && l->shown && number-- == 0) return l.get();
    }
    return nullptr;
}

void ScopeView::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    if (event->button() != Qt::LeftButton) return;
    pressedAt_ = event->position();
    pressedView_ = view_;
    hover_.reset();
    grip_ = overlay_->at(pressedAt_);
    drag_ = Drag::Undecided;
    if (boxZoom_ || event->modifiers().testFlag(Qt::ShiftModifier)) {
        drag_ = Drag::Box;
    } else if (grip_.grip != Grip::None) {
        drag_ = Drag::Grip;
        if (const auto* its = grip_.grip == Grip::Lane ? gripLane(grip_.which) : nullptr) setActiveLane(its->key);
        if (grip_.grip == Grip::TimeCursor) focusCursor(grip_.which);
        if (grip_.grip == Grip::LevelCursor) focusCursor(2 + grip_.which);
    }
}

void ScopeView::mouseMoveEvent(QMouseEvent* event) {
    const auto at = event->position();
    switch (drag_) {
        case Drag::None:
            hover(at);
            return;
        case Drag::Undecided:
            if ((at - pressedAt_).manhattanLength() <= kStillAClick) return;
            drag_ = Drag::Pan;
            history_.remember(view_, {});
            setCursor(Qt::ClosedHandCursor);
            [[fallthrough]];
        case Drag::Pan: {
            view_ = pressedView_;
            panBy(-(at.x() - pressedAt_.x()) * pixelTime(),
                  (pressedAt_.y() - at.y()) * kDivisionsUp / std::max(1, axisRect()->height()));
            apply();
            return;
        }
        case Drag::Box:
            box_ = QRectF(pressedAt_, at).normalized();
            refreshOverlay();
            return;
        case Drag::Grip:
            dragGrip(at);
            return;
    }
}

void ScopeView::panBy(double time_s, double height) {
    view_.left_s = onGrid(view_.left_s + time_s, view_.perDivision_s);
    for (const auto& l : lanes_) {
        if (l->stored || !l->shown) continue;
        auto& scale = view_.lanes[l->key];
        const double before = std::exchange(scale.position, onGrid(scale.position + height, 1));
        if (scale.position != before) untouched_ = false;
    }
}

void ScopeView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    const auto was = std::exchange(drag_, Drag::None);
    if (was == Drag::Box) endBox();
    if (was == Drag::Undecided) pickLane(event->position());
    if (was == Drag::Grip && grip_.grip == Grip::TriggerMoment && wantedMoment_s_ && shown_ && preTrigger_) {
        const double length = shown_->end_s() - shown_->capture->start_s;
        const double chosen = std::clamp(*preTrigger_ + *wantedMoment_s_ / length, 0.0, 1.0);
        preTrigger_ = chosen;
        emit preTriggerChosen(chosen);
    }
    wantedMoment_s_.reset();
    triggerText_.clear();
    grip_ = {};
    refreshOverlay();
    hover(event->position());
}

void ScopeView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    drag_ = Drag::None;
    fit();
}

void ScopeView::endBox() {
    const auto box = box_.value_or(QRectF()).intersected(QRectF(axisRect()->rect()));
    box_.reset();
    if (boxZoom_) {
        boxZoom_ = false;
        emit boxZoomEnded();
    }
    if (box.width() < 2 * kStillAClick || box.height() < 2 * kStillAClick) return refreshOverlay();
    auto next = showingTime(view_, timeAt(box.left()), timeAt(box.right()));
    for (const auto& l : lanes_) {
        if (l->stored || !l->shown) continue;
        next.lanes[l->key] = showingHeights(scaleOf(*l), heightAt(box.bottom()), heightAt(box.top()));
    }
    go(next, {});
}

void ScopeView::setBoxZoom(bool on) {
    boxZoom_ = on;
    setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
}

void ScopeView::dragGrip(const QPointF& pixel) {
    const double height = heightAt(pixel.y());
    switch (grip_.grip) {
        case Grip::Lane: {
            const auto* its = gripLane(grip_.which);
            if (its == nullptr) return;
            auto next = view_;
            next.lanes[its->key].position = onGrid(std::clamp(height, -kDivisionsUp / 2.0, kDivisionsUp / 2.0), 1);
            if (view_ == pressedView_ && next != view_) history_.remember(view_, {});
            untouched_ = false;
            view_ = next;
            return apply();
        }
        case Grip::TriggerLevel: {
            const auto* source = lane(triggerLane_);
            if (source == nullptr || triggerHeld_) return;
            const auto scale = scaleOf(*source);
            // Whole hundredths of a division: a level is chosen with the eye, not to the last digit.
            const double grain = scale.perDivision / 100;
            triggerLevel_ = std::round((height - scale.position) * scale.perDivision / grain) * grain;
            triggerText_ = tr("Trigger at %1").arg(quantityText(triggerLevel_, source->unit, 3));
            emit triggerLevelChosen(triggerLevel_);
            return refreshOverlay();
        }
        case Grip::TriggerMoment: {
            if (!preTrigger_ || !shown_) return;
            const double length = shown_->end_s() - shown_->capture->start_s;
            const double chosen = std::clamp(*preTrigger_ + timeAt(pixel.x()) / length, 0.0, 1.0);
            wantedMoment_s_ = (chosen - *preTrigger_) * length;
            triggerText_ = tr("%1 of the record before the trigger").arg(quantityText(100 * chosen, "%", 2));
            return refreshOverlay();
        }
        case Grip::TimeCursor:
            (*timeCursors_)[static_cast<std::size_t>(grip_.which)] = snappedTime(timeAt(pixel.x()));
            break;
        case Grip::LevelCursor: {
            const auto* active = lane(active_);
            if (active == nullptr) return;
            const auto scale = scaleOf(*active);
            (*levelCursors_)[static_cast<std::size_t>(grip_.which)] =
                snappedLevel((height - scale.position) * scale.perDivision);
            break;
        }
        case Grip::None:
            return;
    }
    emit cursorsChanged();
    refreshOverlay();
}

void ScopeView::wheelEvent(QWheelEvent* event) {
    event->accept();
    const auto turned = event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
    if (turned == 0 || !shown_) return;
    const int steps = turned > 0 ? -1 : 1;  // towards the picture shows less of it
    if (event->modifiers().testFlag(Qt::ControlModifier)) {
        auto* active = lane(active_);
        if (active != nullptr && active->stored) active = lane(active->follows);
        if (active == nullptr) return;
        auto next = view_;
        next.lanes[active->key] = zoomedInLevel(scaleOf(*active), steps, heightAt(event->position().y()));
        return go(next, "level wheel");
    }
    if (event->modifiers().testFlag(Qt::ShiftModifier)) {
        auto next = view_;
        next.left_s = onGrid(next.left_s + steps * next.perDivision_s / 2, next.perDivision_s);
        return go(next, "pan wheel");
    }
    go(zoomedInTime(view_, steps, timeAt(event->position().x())), "time wheel");
}

void ScopeView::leaveEvent(QEvent* event) {
    QCustomPlot::leaveEvent(event);
    if (hover_) {
        hover_.reset();
        refreshOverlay();
    }
}

void ScopeView::hover(const QPointF& pixel) {
    const auto grip = overlay_->at(pixel);
    setCursor(boxZoom_ ? Qt::CrossCursor : shapeFor(grip.grip, triggerHeld_));
    const auto before = hover_;
    hover_.reset();
    const auto* active = lane(active_);
    if (grip.grip == Grip::None && active != nullptr && axisRect()->rect().contains(pixel.toPoint())) {
        hover_ = hoverAt(timeAt(pixel.x()));
    }
    if (before || hover_) refreshOverlay();
}

void ScopeView::pickLane(const QPointF& pixel) {
    const double from = timeAt(pixel.x() - 3), to = timeAt(pixel.x() + 3);
    const double reach = 8.0 * kDivisionsUp / std::max(1, axisRect()->height());
    QString nearest;
    double best = reach;
    for (const auto& l : lanes_) {
        if (!l->shown) continue;
        const auto scale = scaleOf(*l);
        for (const auto& span : l->graph->spans()) {
            const double size = static_cast<double>(span.trace->size());
            const auto index = [&](double t) {
                return static_cast<std::size_t>(std::clamp((t - span.key_s) * span.trace->rate_hz, 0.0, size));
            };
            const auto seen = span.trace->pyramid.over(index(from), index(to) + 1);
            if (seen.empty()) continue;
            const double at = heightAt(pixel.y());
            const double low = static_cast<double>(seen.low) / scale.perDivision + scale.position;
            const double high = static_cast<double>(seen.high) / scale.perDivision + scale.position;
            const double away = at < low ? low - at : at > high ? at - high : 0;
            if (away < best) {
                best = away;
                nearest = l->key;
            }
        }
    }
    if (!nearest.isEmpty()) setActiveLane(nearest);
}

}  // namespace tacto::gui
