#include "app/gui/scope/model/TraceEdges.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

/// The edge with the smallest `distanceTo(edge)` below `reach`; `otherwise` without one.
template <class Distance>
double nearestEdge(const std::vector<TraceSpan>& spans, double otherwise, double reach, Distance distanceTo) {
    double best = otherwise;
    for (const auto& span : spans) {
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& edge : span.trace->edges) {
            for (const double at : {edge.onset_s + shift, edge.end_s + shift}) {
                const double distance = distanceTo(at);
                if (!(distance < reach)) continue;
                reach = distance;
                best = at;
            }
        }
    }
    return best;
}

}  // namespace

double snappedToEdge(const std::vector<TraceSpan>& spans, double time_s, double reach_s) {
    return nearestEdge(spans, time_s, reach_s, [&](double at) { return std::abs(at - time_s); });
}

double nextEdge(const std::vector<TraceSpan>& spans, double time_s, double direction, double least_s) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return nearestEdge(spans, time_s, kInfinity, [&](double at) {
        const double away = (at - time_s) * direction;
        return away > least_s ? away : kInfinity;
    });
}

std::optional<std::pair<double, double>> pulseNear(const std::vector<TraceSpan>& spans, double time_s) {
    std::optional<std::pair<double, double>> nearest;
    for (const auto& span : spans) {
        const auto& edges = span.trace->edges;
        const double shift = span.key_s - span.trace->start_s;
        for (auto edge = edges.begin(); edge != edges.end(); ++edge) {
            const double onset_s = edge->onset_s + shift;
            if (!edge->leading || (nearest && std::abs(onset_s - time_s) >= std::abs(nearest->first - time_s)))
                continue;
            const auto second = std::next(edge);
            const bool biphasic = second != edges.end() && !second->leading;
            nearest = {onset_s, (biphasic ? second->end_s : edge->end_s) + shift};
        }
    }
    return nearest;
}

std::optional<EdgeReading> edgesAround(const std::vector<TraceSpan>& spans, double time_s) {
    for (const auto& span : spans) {
        const auto& edges = span.trace->edges;
        const double shift = span.key_s - span.trace->start_s;
        const double t = time_s - shift;
        if (edges.empty() || t < edges.front().onset_s || t > edges.back().end_s) continue;
        const auto after = std::upper_bound(edges.begin(), edges.end(), t,
                                            [](double at, const PhaseEdges& e) { return at < e.onset_s; });
        const auto& phase = *std::prev(after);
        const bool inside = t <= phase.end_s;
        if (!inside && after == edges.end()) continue;
        EdgeReading read;
        read.from_s = (inside ? phase.onset_s : phase.end_s) + shift;
        read.to_s = (inside ? phase.end_s : after->onset_s) + shift;
        read.text =
            (inside ? QObject::tr("Width %1") : QObject::tr("Rest %1")).arg(quantityText(read.to_s - read.from_s, "s"));
        // The interval runs from the leading edge before the moment to the next leading edge.
        auto before = std::prev(after);
        while (before != edges.begin() && !before->leading) --before;
        const auto next = std::find_if(after, edges.end(), [](const PhaseEdges& e) { return e.leading; });
        if (next != edges.end() && before->leading) {
            const double interval = next->onset_s - before->onset_s;
            read.text +=
                QObject::tr(" · interval %1 (%2)").arg(quantityText(interval, "s"), quantityText(1 / interval, "Hz"));
        }
        return read;
    }
    return {};
}

}  // namespace tacto::gui
