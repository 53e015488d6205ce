#include "app/gui/scope/model/ScopeModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tacto::gui {

std::unique_ptr<ScopeModel> ScopeModel::still() const {
    auto still = std::make_unique<ScopeModel>();
    still->captures_ = captures_;
    still->lanes_ = lanes_;
    still->active_ = active_;
    still->held_ = held_;
    still->coming_ = coming_;
    still->frame_ = frame_;
    still->cursors_ = cursors_;
    still->trigger_ = trigger_;
    still->marks_ = marks_;
    return still;
}

void ScopeModel::setHeld(bool held) {
    if (std::exchange(held_, held) != held) emit heldChanged();
}

void ScopeModel::setComing(const std::optional<ComingTrain>& coming) {
    if (std::exchange(coming_, coming) != coming) emit heldChanged();
}

std::optional<ComingTrain> ScopeModel::coming() const {
    return !roll() && showsBench() && std::isfinite(shown()->capture->trigger_s) ? coming_ : std::nullopt;
}

void ScopeModel::show(ShownPtr shown) {
    setHeld(false);
    if (!captures_.isFollowedBy(*shown)) frame_.keepChosen(scene());
    captures_.show(std::move(shown));
    const bool others = takeLanes();
    const auto& behind = captures_.behind();
    behind.empty() ? frame_.begin(scene()) : frame_.follow(scene(), *behind.front());
    tellTraces(others);
}

void ScopeModel::clear() {
    if (!shown()) return;
    frame_.keepChosen(scene());
    setHeld(false);
    captures_.clear();
    frame_.forgetHistory();
    hovered_.reset();
    lanes_.clear();
    fillLanes();
    chooseActive();
    tellTraces(true);
}

void ScopeModel::replaceMath(ShownPtr shown) {
    captures_.replaceNewest(std::move(shown));
    tellTraces(takeLanes());
}

void ScopeModel::fillLanes() {
    lanes_.fill(captures_.newest(), captures_.behind(), captures_.roll(), captures_.persistence());
}

bool ScopeModel::takeLanes() {
    const bool others = lanes_.take(*shown());
    fillLanes();
    chooseActive();
    frame_.addLanes(scene());
    return others;
}

void ScopeModel::chooseActive() {
    if (active() != nullptr || lanes().empty()) return;
    active_ = lanes().front().key;
    emit activeLaneChanged();
}

void ScopeModel::tellTraces(bool lanesToo) {
    emit tracesChanged();
    if (lanesToo) emit lanesChanged();
    emit viewChanged();
}

void ScopeModel::setPersistence(int captures) {
    captures_.setPersistence(captures);
    fillLanes();
    tellTraces(false);
}

void ScopeModel::setRoll(bool roll) {
    if (roll == captures_.roll()) return;
    cursors_.hideTime();
    trigger_.forgetMoment();
    captures_.setRoll(roll);
    frame_.changeMode(scene());
    fillLanes();
    tellCursors();
    tellTraces(false);
}

QString ScopeModel::channelIn(const QString& unit) const {
    for (const auto& lane : lanes())
        if (!lane.reference() && lane.unit == unit && lane.key.startsWith("channel/")) return lane.key;
    return {};
}

TracePtr ScopeModel::trace(const QString& key) const {
    const auto* its = lane(key);
    if (its == nullptr) return nullptr;
    return its->stored ? its->stored : shown() ? shown()->trace(key) : nullptr;
}

void ScopeModel::setActiveLane(const QString& key) {
    if (key == active_ || lane(key) == nullptr) return;
    if (active() != nullptr) cursors_.changeLane(scaleOf(*active()), scaleOf(*lane(key)));
    active_ = key;
    emit activeLaneChanged();
    emit cursorsChanged();
    emit viewChanged();
}

void ScopeModel::pickLane(double from_s, double to_s, double height, double reach) {
    setActiveLane(lanes_.nearest(viewport(), from_s, to_s, height, reach));
}

void ScopeModel::setLaneShown(const QString& key, bool shown) {
    auto* its = lanes_.find(key);
    if (its == nullptr || its->shown == shown) return;
    its->shown = shown;
    emit lanesChanged();
    emit viewChanged();
}

void ScopeModel::setLaneScale(const QString& key, double perDivision) {
    if (lane(key) == nullptr || !(perDivision > 0)) return;
    auto next = viewport();
    next.lanes[key].perDivision = perDivision;
    go(next, "scale " + key);
}

void ScopeModel::setLanePosition(const QString& key, double position) {
    if (lane(key) == nullptr || !std::isfinite(position)) return;
    auto next = viewport();
    next.lanes[key].position = position;
    go(next, "position " + key);
}

QString ScopeModel::storeReference() {
    const auto source = trace(active_);
    if (!source || active()->reference()) return {};
    const auto key = lanes_.store(active_, *source);
    fillLanes();
    tellTraces(true);
    return key;
}

void ScopeModel::removeReference(const QString& key) {
    if (const auto* its = lane(key); its == nullptr || !its->reference()) return;
    lanes_.remove(QString(key));
    chooseActive();
    tellTraces(true);
}

void ScopeModel::fit() {
    if (!shown()) return;
    frame_.fit(scene());
    emit viewChanged();
}

void ScopeModel::frameFirstPulse() {
    if (frame_.frameFirstPulse(scene())) emit viewChanged();
}

void ScopeModel::go(const Viewport& next, const QString& kind) {
    if (frame_.go(scene(), next, kind)) emit viewChanged();
}

void ScopeModel::become(const Viewport& next) {
    frame_.become(scene(), next);
    emit viewChanged();
}

bool ScopeModel::undoZoom() {
    const bool undone = frame_.undo(scene());
    if (undone) emit viewChanged();
    return undone;
}

double ScopeModel::restingTime_s() const {
    const auto& view = viewport();
    const bool triggerInView = !roll() && view.left_s <= 0 && view.right_s() >= 0;
    return triggerInView ? 0 : view.left_s + view.width_s() / 2;
}

void ScopeModel::setTimePerDivision(double perDivision_s) {
    if (!(perDivision_s > 0)) return;
    const double base_s = std::max(perDivision_s, leastTimePerDivision_s());
    auto next = withTimeBase(viewport(), base_s, restingTime_s());
    if (roll() && shown()) next.left_s = ScopeFrame::rollLeft(scene(), base_s);
    go(next, "time base");
}

double ScopeModel::leastTimePerDivision_s() const { return shown() ? leastPerDivision(shown()->capture->rate_hz) : 0; }

void ScopeModel::setTimeCentre(double centre_s) {
    if (!std::isfinite(centre_s)) return;
    auto next = viewport();
    next.left_s = centre_s - next.width_s() / 2;
    go(next, "time position");
}

void ScopeModel::zoomTime(int steps, double anchor_s, const QString& kind) {
    go(zoomedInTime(viewport(), steps, anchor_s, leastTimePerDivision_s()), kind);
}

void ScopeModel::zoomLevel(int steps, double anchorHeight, const QString& kind) {
    if (active() == nullptr) return;
    auto next = viewport();
    next.lanes[active()->scaleKey()] = zoomedInLevel(scaleOf(*active()), steps, anchorHeight);
    go(next, kind);
}

void ScopeModel::zoomToBox(double from_s, double to_s, double bottom, double top) {
    auto next = spanningTime(viewport(), from_s, to_s, leastTimePerDivision_s());
    for (const auto& l : lanes()) {
        if (!l.reference() && l.shown) next.lanes[l.key] = showingHeights(scaleOf(l), bottom, top);
    }
    go(next, {});
}

void ScopeModel::movedBy(Viewport& view, double time_s, double height) const {
    view.left_s = onGrid(view.left_s + time_s, view.perDivision_s);
    for (const auto& l : lanes()) {
        if (l.reference() || !l.shown) continue;
        auto& position = view.lanes[l.key].position;
        position = onGrid(position + height, 1);
    }
}

void ScopeModel::pan(double time_s, double height, const QString& kind) {
    auto next = viewport();
    movedBy(next, time_s, height);
    go(next, kind);
}

void ScopeModel::dragView(const Viewport& from, double time_s, double height) {
    auto next = from;
    movedBy(next, time_s, height);
    become(next);
}

void ScopeModel::dragLane(const Viewport& from, const QString& key, double height) {
    if (lane(key) == nullptr) return;
    auto next = viewport();
    next.lanes[key].position = onGrid(std::clamp(height, -kHalfUp, kHalfUp), 1);
    if (viewport() == from && next != viewport()) remember();
    become(next);
}

void ScopeModel::tellCursors() {
    emit cursorsChanged();
    emit overlayChanged();
}

std::optional<std::pair<double, double>> ScopeModel::pulseInSight() const {
    return pulseWithin(lanes_.edgesFor(active_), viewport().left_s, viewport().right_s(), restingTime_s());
}

std::optional<std::pair<double, double>> ScopeModel::levelsInSight() const {
    const auto its = trace(active_);
    const auto pulse = pulseInSight();
    if (!its || !pulse || its->levels.size() < 2) return {};
    const double inside_s = pulse->first + (pulse->second - pulse->first) / 1000;
    const auto leading = edgesAround(lanes_.edgesFor(active_), inside_s);
    if (!leading) return {};
    const double top = its->valueAt((leading->from_s + leading->to_s) / 2 + (roll() ? 0 : its->zero_s));
    const auto resting = std::min_element(its->levels.begin(), its->levels.end(),
                                          [top](double a, double b) { return std::abs(a - top) < std::abs(b - top); });
    if (!std::isfinite(top) || resting == its->levels.begin()) return {};
    return std::pair{its->levels.front(), *resting};
}

void ScopeModel::setTimeCursors(bool on) {
    if (on == cursors_.time_s().has_value()) return;
    on ? cursors_.showTime(viewport(), pulseInSight()) : cursors_.hideTime();
    tellCursors();
}

void ScopeModel::setLevelCursors(bool on) {
    if (on == cursors_.level().has_value() || (on && active() == nullptr)) return;
    on ? cursors_.showLevel(scaleOf(*active()), levelsInSight()) : cursors_.hideLevel();
    tellCursors();
}

void ScopeModel::focusCursor(int cursor) {
    cursors_.focus(cursor);
    emit overlayChanged();
}

void ScopeModel::dragTimeCursor(int which, double time_s, double reach_s) {
    if (!cursors_.time_s()) return;
    cursors_.placeTime(which, snappedToEdge(lanes_.edgesFor(active_), time_s, reach_s));
    tellCursors();
}

void ScopeModel::dragLevelCursor(int which, double height, double reach) {
    const auto its = trace(active_);
    if (!cursors_.level() || active() == nullptr) return;
    const auto scale = scaleOf(*active());
    const double level = scale.levelAt(height);
    double best = level, distance = reach * scale.perDivision;
    for (const double rest : its ? its->levels : std::vector<double>{}) {
        if (std::abs(rest - level) >= distance) continue;
        distance = std::abs(rest - level);
        best = rest;
    }
    cursors_.placeLevel(which, best);
    tellCursors();
}

bool ScopeModel::nudgeTimeCursor(double by_s) {
    if (!cursors_.timeFocused()) return false;
    const int which = cursors_.focused();
    const double at = (*cursors_.time_s())[static_cast<std::size_t>(which)] + by_s;
    cursors_.placeTime(which, at);
    hovered_ = edgesAround(lanes_.edgesFor(active_), at);  // the edges around this cursor, as if the mouse were there
    tellCursors();
    return true;
}

bool ScopeModel::jumpTimeCursor(double direction) {
    if (!cursors_.timeFocused()) return false;
    const double at = (*cursors_.time_s())[static_cast<std::size_t>(cursors_.focused())];
    return nudgeTimeCursor(nextEdge(lanes_.edgesFor(active_), at, direction, viewport().width_s() * 1e-9) - at);
}

bool ScopeModel::nudgeLevelCursor(double byHeight) {
    if (!cursors_.levelFocused() || active() == nullptr) return false;
    const int which = cursors_.focused() - 2;
    cursors_.placeLevel(
        which, (*cursors_.level())[static_cast<std::size_t>(which)] + byHeight * scaleOf(*active()).perDivision);
    tellCursors();
    return true;
}

std::vector<CursorValue> ScopeModel::cursorValues() const { return cursors_.values(lanes()); }

CursorReadout ScopeModel::readout() const {
    return active() == nullptr ? CursorReadout{} : cursors_.readout(*active());
}

void ScopeModel::hover(std::optional<double> time_s) {
    auto now = time_s && active() != nullptr ? edgesAround(lanes_.edgesFor(active_), *time_s) : std::nullopt;
    if (now == hovered_) return;
    hovered_ = std::move(now);
    emit overlayChanged();
}

void ScopeModel::addMark(MomentMark mark) {
    marks_.add(std::move(mark));
    emit overlayChanged();
}

void ScopeModel::clearMarks() {
    marks_.clear();
    emit overlayChanged();
}

std::vector<MomentMark> ScopeModel::marksOnAxis() const {
    if (!showsBench()) return {};
    return marks_.between(viewport().left_s, viewport().right_s(), zero_s());
}

QString ScopeModel::markBeside() const {
    if (!showsBench() || roll()) return {};
    const auto& behind = captures_.behind();
    return marks_.beside(*shown(), behind.empty() ? nullptr : behind.front().get());
}

void ScopeModel::setTrigger(const QString& key, const SampleTrigger& trigger, bool held) {
    if (trigger_.set(key, trigger, held)) emit overlayChanged();
}

void ScopeModel::dragTriggerLevel(double height, bool other) {
    const auto* source = lane(trigger_.lane());
    if (source == nullptr || !trigger_.dragLevel(other, height, scaleOf(*source), source->unit)) return;
    other ? emit triggerUpperChosen(trigger_.its().upper) : emit triggerLevelChosen(trigger_.level());
    emit overlayChanged();
}

void ScopeModel::dragTriggerMoment(double time_s) {
    if (shown() && trigger_.dragMoment(time_s, shown()->length_s())) emit overlayChanged();
}

void ScopeModel::markTrigger(std::optional<double> time_s) {
    trigger_.setMoment(time_s);
    emit overlayChanged();
}

void ScopeModel::dropTrigger() {
    if (const auto chosen = trigger_.drop(shown() ? shown()->length_s() : 1)) emit preTriggerChosen(*chosen);
    emit overlayChanged();
}

}  // namespace tacto::gui

#include "moc_ScopeModel.cpp"
