// Which part is on the screen: fitting it, choosing it, going back.
#include <algorithm>
#include <cmath>

#include "app/gui/scope/ScopeView.h"

namespace tacto::gui {

namespace {

constexpr double kHalfHeight = kDivisionsUp / 2.0;

}  // namespace

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
        const double least = newest->low < newest->high ? (newest->high - newest->low) / 60
                             : low == high              ? std::max(1e-3, std::abs(low))
                                                        : 0;
        if (high - low < least) {
            const double middle = (low + high) / 2;
            low = middle - least / 2;
            high = middle + least / 2;
        }
        const double middle = l->shown ? kHalfHeight - (place++ + 0.5) * height : 0;
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
        if (static_cast<double>(all.high) / scale.perDivision + scale.position > kHalfHeight ||
            static_cast<double>(all.low) / scale.perDivision + scale.position < -kHalfHeight) {
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

bool ScopeView::showsWhole(const ShownCapture& shown) const {
    const auto fitted = showingTime(view_, shown.capture->start_s - shown.zero_s, shown.end_s() - shown.zero_s);
    return std::abs(fitted.left_s - view_.left_s) < view_.perDivision_s / 10 &&
           fitted.perDivision_s == view_.perDivision_s;
}

ChosenView ScopeView::chosenView() const {
    if (!shown_ || !shown_->source.isEmpty()) return chosen_;
    ChosenView chosen;
    if (!roll_ && !showsWhole(*shown_)) chosen.time = ChosenView::Time{view_.left_s, view_.perDivision_s};
    if (untouched_) return chosen;
    for (const auto& l : lanes_) {
        if (!l->stored) chosen.lanes[l->key] = scaleOf(*l);
    }
    return chosen;
}

void ScopeView::takeChosenView() {
    if (!shown_->source.isEmpty()) return;
    if (chosen_.time && !roll_) {
        view_.left_s = chosen_.time->left_s;
        view_.perDivision_s = chosen_.time->perDivision_s;
    }
    for (const auto& [key, scale] : chosen_.lanes) {
        if (lane(key) == nullptr) continue;
        view_.lanes[key] = scale;
        untouched_ = false;
    }
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

double ScopeView::rollLeft(double perDivision_s) const {
    const double left = onGrid(shown_->end_s() - perDivision_s * kDivisionsAcross, perDivision_s);
    return std::max(left, std::min(0.0, shown_->capture->start_s));  // before a session there is no time
}

void ScopeView::setTimePerDivision(double perDivision_s) {
    if (!(perDivision_s > 0)) return;
    auto next = view_;
    const double centre = view_.left_s + view_.width_s() / 2;
    next.perDivision_s = perDivision_s;
    next.left_s = onGrid(centre - next.width_s() / 2, perDivision_s);
    if (roll_ && shown_) next.left_s = rollLeft(perDivision_s);
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

}  // namespace tacto::gui
