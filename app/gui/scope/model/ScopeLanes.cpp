#include "app/gui/scope/model/ScopeLanes.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

/// Places a trace on the axis on which the trigger is 0.
TraceSpan fromTrigger(const TracePtr& trace) { return {trace, trace ? trace->start_s - trace->zero_s : 0}; }

constexpr double kPairZero = 1.5;  // divisions between the middle and each zero of a pair

/// Returns the range of values to show; nothing for a reference or if the capture lacks this lane.
std::optional<std::pair<double, double>> rangeOf(const ScopeLane& lane, const ShownCapture& newest) {
    const auto trace = lane.reference() ? nullptr : newest.trace(lane.key);
    if (!trace) return std::nullopt;
    auto all = lane.envelope();
    const auto whole = trace->pyramid.over(0, trace->size());
    all.low = std::min(all.low, whole.low);
    all.high = std::max(all.high, whole.high);
    double low = all.empty() ? 0 : static_cast<double>(all.low);
    double high = all.empty() ? 0 : static_cast<double>(all.high);
    // A flat line is not magnified until its smallest steps fill the screen.
    const double least = trace->low < trace->high ? (trace->high - trace->low) / 60
                         : low == high            ? std::max(1e-3, std::abs(low))
                                                  : 0;
    if (high - low < least) {
        const double middle = (low + high) / 2;
        low = middle - least / 2;
        high = middle + least / 2;
    }
    return std::pair(low, high);
}

}  // namespace

Envelope ScopeLane::envelope() const {
    Envelope all;
    for (const auto& span : spans) {
        const auto its = span.trace->pyramid.over(0, span.trace->size());
        all.low = std::min(all.low, its.low);
        all.high = std::max(all.high, its.high);
    }
    return all;
}

ScopeLane* ScopeLanes::find(const QString& key) { return const_cast<ScopeLane*>(std::as_const(*this).find(key)); }

const ScopeLane* ScopeLanes::find(const QString& key) const {
    const auto found = std::find_if(lanes_.begin(), lanes_.end(), [&](const ScopeLane& l) { return l.key == key; });
    return found == lanes_.end() ? nullptr : &*found;
}

bool ScopeLanes::take(const ShownCapture& shown) {
    bool changed = std::erase_if(lanes_, [&](const ScopeLane& l) { return !l.stored && !shown.trace(l.key); }) > 0;
    for (const auto& trace : shown.traces) {
        auto* lane = find(trace->key);
        if (lane == nullptr) {
            lane = &lanes_.emplace_back();
            lane->key = trace->key;
            changed = true;
        }
        changed = changed || lane->title != trace->title || lane->unit != trace->unit;
        lane->title = trace->title;
        lane->unit = trace->unit;
        lane->letter = trace->letter;
    }
    return changed;
}

void ScopeLanes::clear() {
    std::erase_if(lanes_, [](const ScopeLane& l) { return !l.stored; });
}

void ScopeLanes::fill(const ShownPtr& newest, const std::deque<ShownPtr>& older, bool roll, int persistence) {
    const auto behind = std::min(older.size(), static_cast<std::size_t>(persistence));
    for (auto& lane : lanes_) {
        lane.spans.clear();
        lane.behind.clear();
        if (lane.stored) {
            if (!roll) lane.spans.push_back(fromTrigger(lane.stored));
            continue;
        }
        const auto latest = newest ? newest->trace(lane.key) : nullptr;
        if (roll) {
            const auto add = [&](const TracePtr& trace) {
                if (trace) lane.spans.push_back({trace, trace->start_s});
            };
            std::for_each(older.rbegin(), older.rend(), [&](const ShownPtr& s) { add(s->trace(lane.key)); });
            add(latest);
        } else {
            if (latest) lane.spans.push_back(fromTrigger(latest));
            for (std::size_t i = behind; i-- > 0;) lane.behind.push_back(fromTrigger(older[i]->trace(lane.key)));
        }
    }
}

QString ScopeLanes::store(const QString& source, const Trace& trace) {
    ScopeLane lane;
    lane.key = QString("reference/%1").arg(++stored_);
    lane.letter = QString("R%1").arg(stored_);
    lane.follows = source;
    auto copy = makeTrace(lane.key, QObject::tr("%1, stored").arg(trace.title), trace.unit, trace.samples,
                          trace.rate_hz, trace.start_s, trace.zero_s);
    copy->levels = trace.levels;
    copy->edges = trace.edges;
    lane.title = copy->title;
    lane.unit = copy->unit;
    lane.stored = std::move(copy);
    lanes_.push_back(std::move(lane));
    return lanes_.back().key;
}

void ScopeLanes::remove(const QString& key) {
    std::erase_if(lanes_, [&](const ScopeLane& l) { return l.key == key; });
}

const std::vector<TraceSpan>& ScopeLanes::edgesFor(const QString& key) const {
    static const std::vector<TraceSpan> kNone;
    const std::vector<TraceSpan>* first = nullptr;
    for (const auto& lane : lanes_) {
        const bool has = std::any_of(lane.spans.begin(), lane.spans.end(),
                                     [](const TraceSpan& s) { return !s.trace->edges.empty(); });
        if (!has) continue;
        if (lane.key == key) return lane.spans;
        if (first == nullptr && lane.shown) first = &lane.spans;
    }
    return first == nullptr ? kNone : *first;
}

QString ScopeLanes::nearest(const Viewport& view, double from_s, double to_s, double height, double reach) const {
    QString nearest;
    for (const auto& lane : lanes_) {
        if (!lane.shown) continue;
        const auto scale = view.scale(lane.scaleKey());
        for (const auto& span : lane.spans) {
            const double size = static_cast<double>(span.trace->size());
            const auto index = [&](double t) {
                return static_cast<std::size_t>(std::clamp((t - span.key_s) * span.trace->rate_hz, 0.0, size));
            };
            const auto seen = span.trace->pyramid.over(index(from_s), index(to_s) + 1);
            if (seen.empty()) continue;
            const double low = scale.heightOf(static_cast<double>(seen.low));
            const double high = scale.heightOf(static_cast<double>(seen.high));
            const double away = height < low ? low - height : height > high ? height - high : 0;
            if (away < reach) {
                reach = away;
                nearest = lane.key;
            }
        }
    }
    return nearest;
}

void ScopeLanes::fit(const ShownCapture& newest, Viewport& view) const {
    const auto visible =
        std::count_if(lanes_.begin(), lanes_.end(), [](const ScopeLane& l) { return !l.reference() && l.shown; });
    const auto count = static_cast<double>(std::max<std::ptrdiff_t>(1, visible));
    const double room = kDivisionsUp / count;
    // The zeros of two lanes stand 1.5 divisions above and below the middle.
    const bool pair = visible == 2 && std::all_of(lanes_.begin(), lanes_.end(), [&](const ScopeLane& lane) {
                          const auto range = lane.shown ? rangeOf(lane, newest) : std::nullopt;
                          return !range || (range->first <= 0 && range->second >= 0);
                      });
    int place = 0;
    std::optional<double> first;
    for (const auto& lane : lanes_) {
        const auto range = rangeOf(lane, newest);
        if (!range) continue;
        const auto [low, high] = *range;
        if (pair && lane.shown) {
            view.lanes[lane.key] = aroundZero(low, high, place++ == 0 ? kPairZero : -kPairZero);
            continue;
        }
        // A hidden lane needs no room. Its zero is set to the middle, for when it is shown.
        const double middle = lane.shown ? kHalfUp - (place++ + 0.5) * room : 0;
        // Lanes may overlap a little: otherwise half a division would often halve their scale.
        auto scale = restingLevels(low, high, middle, room * (count > 1 ? 1.08 : 0.95));
        // If possible, zeros are whole divisions apart: the grid lines then have round values in every lane.
        if (first) {
            const double apart = *first + std::round(scale.position - *first);
            const auto fits = [&](double level) { return std::abs(level / scale.perDivision + apart) < kHalfUp; };
            if (fits(low) && fits(high)) scale.position = apart;
        } else if (lane.shown) {
            first = scale.position;
        }
        view.lanes[lane.key] = scale;
    }
}

bool ScopeLanes::outgrow(const ShownCapture& newest, const Viewport& view) const {
    return std::any_of(lanes_.begin(), lanes_.end(), [&](const ScopeLane& lane) {
        const auto trace = lane.reference() || !lane.shown ? nullptr : newest.trace(lane.key);
        if (!trace) return false;
        const auto all = trace->pyramid.over(0, trace->size());
        const auto scale = view.scale(lane.key);
        return !all.empty() && (scale.heightOf(static_cast<double>(all.high)) > kHalfUp ||
                                scale.heightOf(static_cast<double>(all.low)) < -kHalfUp);
    });
}

}  // namespace tacto::gui
