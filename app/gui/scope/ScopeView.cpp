#include "app/gui/scope/ScopeView.h"

#include <algorithm>
#include <cmath>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMaxInRoll = 600;
constexpr double kRollPerDivision_s = 1;  ///< at least
constexpr std::size_t kMaxSamplesKept = 40'000'000;

QString letterFor(const Trace& trace, const std::vector<TracePtr>& all) {
    if (trace.key == "math/power") return "P";
    if (trace.key == "math/charge") return "Q";
    if (trace.key == "math/difference") return "Δ";
    int number = 0, alike = 0;
    for (const auto& other : all) {
        if (!other->key.startsWith("channel/") || other->unit != trace.unit) continue;
        ++alike;
        if (other->key == trace.key) number = alike;
    }
    const QString letter = trace.unit == "V" ? "V" : trace.unit == "A" ? "I" : "D";
    return alike > 1 ? letter + QString::number(number) : letter;
}

}  // namespace

ScopeView::Lane* ScopeView::lane(const QString& key) { return const_cast<Lane*>(std::as_const(*this).lane(key)); }

const ScopeView::Lane* ScopeView::lane(const QString& key) const {
    for (const auto& l : lanes_) {
        if (l->key == key) return l.get();
    }
    return nullptr;
}

LaneScale ScopeView::scaleOf(const Lane& lane) const {
    const auto found = view_.lanes.find(lane.follows.isEmpty() ? lane.key : lane.follows);
    return found == view_.lanes.end() ? LaneScale{} : found->second;
}

const EnvelopeGraph* ScopeView::graph(const QString& key) const {
    const auto* its = lane(key);
    return its == nullptr ? nullptr : its->graph;
}

TracePtr ScopeView::trace(const QString& key) const {
    const auto* its = lane(key);
    if (its == nullptr) return nullptr;
    return its->stored ? its->stored : shown_ ? shown_->trace(key) : nullptr;
}

void ScopeView::show(ShownPtr shown) {
    // A view that showed the whole record goes on to show the whole record when its length or pre-trigger changes.
    bool whole = false;
    if (shown_ && shown_->source.isEmpty() && shown->source.isEmpty()) {
        const auto placed = [](const ShownCapture& s) { return s.capture->start_s - s.zero_s; };
        const double length = shown_->end_s() - shown_->capture->start_s;
        whole = showsWhole(*shown_) && (std::abs(placed(*shown_) - placed(*shown)) > length / 50 ||
                                        std::abs(shown->end_s() - shown->capture->start_s - length) > length / 50);
        older_.push_front(std::move(shown_));
    } else {
        chosen_ = chosenView();
        older_.clear();
    }
    shown_ = std::move(shown);
    dropOldest();
    takeLanes();
    if (older_.empty()) {
        history_ = {};
        if (!roll_) fitTime();
        if (roll_) view_.perDivision_s = std::max(view_.perDivision_s, kRollPerDivision_s);
        fitLanes(view_);
        untouched_ = true;
        takeChosenView();
    } else if (whole && !roll_) {
        fitTime();
    }
    if (untouched_ && outgrown()) fitLanes(view_);
    if (roll_) view_.left_s = rollLeft(view_.perDivision_s);
    fillGraphs();
    apply();
}

void ScopeView::dropOldest() {
    const std::size_t most = roll_ ? kMaxInRoll : static_cast<std::size_t>(kMaxBehind);
    std::size_t keep = 0;
    std::size_t samples = 0;
    while (keep < older_.size() && keep < most) {
        samples += older_[keep]->capture->samples() * older_[keep]->traces.size();
        if (samples > kMaxSamplesKept) break;
        ++keep;
    }
    older_.resize(keep);
}

void ScopeView::replaceMath(ShownPtr shown) {
    shown_ = std::move(shown);
    takeLanes();
    fillGraphs();
    apply();
}

void ScopeView::clear() {
    chosen_ = chosenView();
    shown_.reset();
    older_.clear();
    while (!lanes_.empty()) removeLane(lanes_.back()->key);
    view_ = {};
    history_ = {};
    ground_->setRecords({});
    emit lanesChanged();
    apply();
}

void ScopeView::takeLanes() {
    bool changed = false;
    for (std::size_t i = lanes_.size(); i-- > 0;) {
        const auto& key = lanes_[i]->key;
        if (lanes_[i]->stored || shown_->trace(key)) continue;
        removeLane(key);
        changed = true;
    }
    for (const auto& trace : shown_->traces) {
        auto* known = lane(trace->key);
        if (known == nullptr) {
            auto fresh = std::make_unique<Lane>();
            fresh->key = trace->key;
            fresh->graph = new EnvelopeGraph(xAxis, yAxis);
            known = fresh.get();
            lanes_.push_back(std::move(fresh));
            changed = true;
        }
        changed = changed || known->title != trace->title || known->unit != trace->unit;
        known->title = trace->title;
        known->unit = trace->unit;
        known->letter = letterFor(*trace, shown_->traces);
    }
    if (lane(active_) == nullptr && !lanes_.empty()) {
        active_ = lanes_.front()->key;
        emit activeLaneChanged();
    }
    // A new lane begins with a scale of its own that shows it; what is there keeps its place.
    for (const auto& l : lanes_) {
        if (l->stored || view_.lanes.contains(l->key)) continue;
        Viewport fitted = view_;
        fitLanes(fitted);
        view_.lanes[l->key] = fitted.lanes[l->key];
    }
    if (changed) {
        restyle();
        emit lanesChanged();
    }
}

void ScopeView::removeLane(QString key) {
    const auto found = std::find_if(lanes_.begin(), lanes_.end(), [&](const auto& l) { return l->key == key; });
    if (found == lanes_.end()) return;
    for (auto* graph : (*found)->behind) removePlottable(graph);
    removePlottable((*found)->graph);
    lanes_.erase(found);
    if (active_ == key) active_.clear();
}

void ScopeView::fillGraphs() {
    std::vector<std::pair<double, double>> records;
    const auto record = [&](const ShownCapture& s) {
        const double zero = roll_ ? 0 : s.zero_s;
        records.emplace_back(s.capture->start_s - zero, s.end_s() - zero);
    };
    if (roll_) std::for_each(older_.rbegin(), older_.rend(), [&](const ShownPtr& s) { record(*s); });
    if (shown_) record(*shown_);
    ground_->setRecords(std::move(records));
    const auto behind = std::min(older_.size(), static_cast<std::size_t>(roll_ ? 0 : persistence_));
    for (const auto& l : lanes_) {
        std::vector<TraceSpan> spans;
        const auto add = [&](const TracePtr& trace) {
            if (trace) spans.push_back({trace, roll_ ? trace->start_s : trace->start_s - trace->zero_s});
        };
        if (l->stored) {
            if (!roll_) add(l->stored);
        } else {
            if (roll_) std::for_each(older_.rbegin(), older_.rend(), [&](const ShownPtr& s) { add(s->trace(l->key)); });
            if (shown_) add(shown_->trace(l->key));
        }
        l->graph->setSpans(std::move(spans));
        const std::size_t wanted = l->stored ? 0 : behind;
        const bool other = wanted != l->behind.size();
        while (l->behind.size() > wanted) {
            removePlottable(l->behind.back());
            l->behind.pop_back();
        }
        while (l->behind.size() < wanted) {
            auto* graph = new EnvelopeGraph(xAxis, yAxis);
            graph->setLayer("behind");
            graph->setMarked(false);
            l->behind.push_back(graph);
        }
        if (other) restyle();
        for (std::size_t i = 0; i < wanted; ++i) {  // the last drawn is the newest
            const auto trace = older_[wanted - 1 - i]->trace(l->key);
            l->behind[i]->setSpans(trace ? std::vector<TraceSpan>{{trace, trace->start_s - trace->zero_s}}
                                         : std::vector<TraceSpan>{});
        }
    }
    watermark_->setVisible(shown_ && shown_->capture->simulated);
}

std::vector<LaneInfo> ScopeView::lanes() const {
    std::vector<LaneInfo> infos;
    for (const auto& l : lanes_) {
        infos.push_back(
            {l->key, l->title, l->letter, l->unit, colourOf(*l), l->shown, l->stored != nullptr, scaleOf(*l)});
    }
    return infos;
}

void ScopeView::setLaneShown(const QString& key, bool shown) {
    auto* its = lane(key);
    if (its == nullptr || its->shown == shown) return;
    its->shown = shown;
    emit lanesChanged();
    apply();
}

void ScopeView::setLaneScale(const QString& key, double perDivision) {
    if (lane(key) == nullptr || !(perDivision > 0)) return;
    auto next = view_;
    next.lanes[key].perDivision = perDivision;
    go(next, "scale " + key);
}

void ScopeView::setLanePosition(const QString& key, double position) {
    if (lane(key) == nullptr || !std::isfinite(position)) return;
    auto next = view_;
    next.lanes[key].position = position;
    go(next, "position " + key);
}

void ScopeView::setActiveLane(const QString& key) {
    if (key == active_ || lane(key) == nullptr) return;
    // Level cursors stay where they are on the screen and read the other lane.
    if (levelCursors_) {
        const auto before = scaleOf(*lane(active_));
        const auto after = scaleOf(*lane(key));
        for (auto& level : *levelCursors_) {
            level = (level / before.perDivision + before.position - after.position) * after.perDivision;
        }
    }
    active_ = key;
    emit activeLaneChanged();
    emit cursorsChanged();
    apply();
}

void ScopeView::setPersistence(int captures) {
    persistence_ = std::clamp(captures, 0, kMaxBehind);
    fillGraphs();
    apply();
}

void ScopeView::setRoll(bool roll) {
    if (roll == roll_) return;
    roll_ = roll;
    timeCursors_.reset();
    wantedMoment_s_.reset();
    history_ = {};
    if (roll_ && shown_) {
        view_.perDivision_s = std::max(view_.perDivision_s, kRollPerDivision_s);
        view_.left_s = rollLeft(view_.perDivision_s);
    } else {
        dropOldest();
        fitTime();
    }
    fillGraphs();
    emit cursorsChanged();
    apply();
}

QString ScopeView::storeReference() {
    const auto source = trace(active_);
    if (!source || lane(active_)->stored) return {};
    auto stored = std::make_unique<Lane>();
    stored->key = QString("reference/%1").arg(++references_);
    auto copy = makeTrace(stored->key, tr("%1, stored").arg(source->title), source->unit, source->samples,
                          source->rate_hz, source->start_s, source->zero_s);
    copy->levels = source->levels;
    copy->edges = source->edges;
    stored->title = copy->title;
    stored->unit = copy->unit;
    stored->letter = QString("R%1").arg(references_);
    stored->follows = active_;
    stored->stored = copy;
    stored->graph = new EnvelopeGraph(xAxis, yAxis);
    stored->graph->setLayer("behind");
    const auto key = stored->key;
    lanes_.push_back(std::move(stored));
    fillGraphs();
    restyle();
    emit lanesChanged();
    apply();
    return key;
}

void ScopeView::removeReference(const QString& key) {
    const auto* its = lane(key);
    if (its == nullptr || !its->stored) return;
    removeLane(key);
    emit lanesChanged();
    apply();
}

}  // namespace tacto::gui
