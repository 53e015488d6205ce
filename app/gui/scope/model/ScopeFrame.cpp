#include "app/gui/scope/model/ScopeFrame.h"

#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

namespace {

constexpr double kRollPerDivision_s = 1;  ///< shortest time base in roll mode

}  // namespace

double ScopeFrame::rollLeft(const Scene& scene, double perDivision_s) {
    const double left = onGrid(scene.shown->end_s() - perDivision_s * kDivisionsAcross, perDivision_s);
    return std::max(left, std::min(0.0, scene.shown->capture->start_s));  // nothing exists before the session starts
}

void ScopeFrame::begin(const Scene& scene) {
    history_ = {};
    if (!scene.roll) fitTime(scene, view_);
    timeView_ = TimeView::Whole;
    if (scene.roll) view_.perDivision_s = std::max(view_.perDivision_s, kRollPerDivision_s);
    scene.lanes.fit(*scene.shown, view_);
    untouched_ = true;
    takeChosen(scene);
    growAndRoll(scene);
}

void ScopeFrame::follow(const Scene& scene, const ShownCapture& before) {
    if (!scene.roll) followTime(scene, before);
    growAndRoll(scene);
}

void ScopeFrame::growAndRoll(const Scene& scene) {
    if (untouched_ && scene.lanes.outgrow(*scene.shown, view_)) scene.lanes.fit(*scene.shown, view_);
    if (scene.roll) view_.left_s = rollLeft(scene, view_.perDivision_s);
}

void ScopeFrame::followTime(const Scene& scene, const ShownCapture& before) {
    if (timeView_ == TimeView::Chosen) return;
    const auto placed = [](const ShownCapture& s) { return s.capture->start_s - s.zero_s; };
    const double length = before.length_s();
    const bool moved = std::abs(placed(before) - placed(*scene.shown)) > length / 50 ||
                       std::abs(scene.shown->length_s() - length) > length / 50;
    if (timeView_ == TimeView::Whole) {
        if (moved) fitTime(scene, view_);
        return;
    }
    if (!pulseNear(scene.lanes.edgesFor(scene.active), 0)) return;
    auto next = view_;
    framePulse(scene, next);
    constexpr double kJitter = 0.2;
    if (std::abs(next.perDivision_s / view_.perDivision_s - 1) > kJitter ||
        std::abs(next.left_s - view_.left_s) > view_.perDivision_s) {
        view_ = next;
    }
}

void ScopeFrame::addLanes(const Scene& scene) {
    Viewport fitted = view_;
    scene.lanes.fit(*scene.shown, fitted);
    view_.lanes.insert(fitted.lanes.begin(), fitted.lanes.end());
}

void ScopeFrame::changeMode(const Scene& scene) {
    history_ = {};
    if (scene.roll && scene.shown) {
        view_.perDivision_s = std::max(view_.perDivision_s, kRollPerDivision_s);
        view_.left_s = rollLeft(scene, view_.perDivision_s);
    } else {
        fitTime(scene, view_);
        timeView_ = TimeView::Whole;
    }
}

void ScopeFrame::fitTime(const Scene& scene, Viewport& view) const {
    if (!scene.shown) return;
    double from = scene.shown->capture->start_s;
    if (scene.roll && !scene.older.empty()) from = std::min(from, scene.older.back()->capture->start_s);
    const double zero = scene.roll ? 0 : scene.shown->zero_s;
    view = showingTime(view, from - zero, scene.shown->end_s() - zero);
}

void ScopeFrame::framePulse(const Scene& scene, Viewport& view) const {
    if (!scene.shown) return;
    const auto pulse = scene.roll ? std::nullopt : pulseNear(scene.lanes.edgesFor(scene.active), 0);
    fitTime(scene, view);
    if (!pulse) return;
    const auto framed = framingPulse(view, pulse->first, pulse->second);
    if (framed.perDivision_s < view.perDivision_s) view = framed;
}

bool ScopeFrame::frameFirstPulse(const Scene& scene) {
    if (timeView_ != TimeView::Whole || scene.roll || !scene.shown) return false;
    auto next = view_;
    framePulse(scene, next);
    const bool moved = go(scene, next, {});
    timeView_ = showsWhole(*scene.shown) ? TimeView::Whole : TimeView::Pulse;
    return moved;
}

bool ScopeFrame::showsWhole(const ShownCapture& shown) const {
    const auto fitted = showingTime(view_, shown.capture->start_s - shown.zero_s, shown.end_s() - shown.zero_s);
    return std::abs(fitted.left_s - view_.left_s) < view_.perDivision_s / 10 &&
           fitted.perDivision_s == view_.perDivision_s;
}

ChosenView ScopeFrame::chosen(const Scene& scene) const {
    if (!scene.shown || !scene.shown->source.isEmpty()) return chosen_;
    ChosenView chosen;
    if (!scene.roll && timeView_ == TimeView::Chosen) chosen.time = ChosenView::Time{view_.left_s, view_.perDivision_s};
    if (untouched_) return chosen;
    for (const auto& lane : scene.lanes.all()) {
        if (!lane.reference()) chosen.lanes[lane.key] = view_.scale(lane.scaleKey());
    }
    return chosen;
}

void ScopeFrame::takeChosen(const Scene& scene) {
    if (!scene.shown->source.isEmpty()) return;
    if (chosen_.time && !scene.roll) {
        view_.left_s = chosen_.time->left_s;
        view_.perDivision_s = chosen_.time->perDivision_s;
        timeView_ = TimeView::Chosen;
    }
    for (const auto& [key, scale] : chosen_.lanes) {
        if (scene.lanes.find(key) == nullptr) continue;
        view_.lanes[key] = scale;
        untouched_ = false;
    }
}

void ScopeFrame::fit(const Scene& scene) {
    auto next = view_;
    framePulse(scene, next);
    scene.lanes.fit(*scene.shown, next);
    constexpr double kSame = 0.08;  // a pulse counts as unchanged despite some jitter
    const bool again = timeView_ == TimeView::Pulse && next.lanes == view_.lanes &&
                       std::abs(next.perDivision_s / view_.perDivision_s - 1) < kSame;
    if (again) fitTime(scene, next);
    static_cast<void>(go(scene, next, {}));
    timeView_ = scene.roll || showsWhole(*scene.shown) ? TimeView::Whole : TimeView::Pulse;
    untouched_ = true;
}

bool ScopeFrame::go(const Scene& scene, const Viewport& next, const QString& kind) {
    if (next == view_) return false;
    history_.remember(view_, kind);
    become(scene, next);
    return true;
}

void ScopeFrame::become(const Scene& scene, const Viewport& next) {
    if (next.lanes != view_.lanes) untouched_ = false;
    const bool moved = next.left_s != view_.left_s || next.perDivision_s != view_.perDivision_s;
    view_ = next;
    if (moved) timeView_ = scene.shown && !scene.roll && showsWhole(*scene.shown) ? TimeView::Whole : TimeView::Chosen;
}

bool ScopeFrame::undo(const Scene& scene) {
    const auto before = history_.undo();
    if (!before) return false;
    untouched_ = false;
    auto next = *before;
    next.lanes.insert(view_.lanes.begin(), view_.lanes.end());  // lanes that were added later keep their scale
    become(scene, next);
    return true;
}

}  // namespace tacto::gui
