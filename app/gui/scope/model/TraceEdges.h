// TraceEdges.h - the edges of measured pulses on the screen's time axis: what a cursor snaps to, which one comes next,
// and how wide the phase or rest around a moment is.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// Two neighbouring edges and what lies between them, in words.
struct EdgeReading {
    double from_s = 0, to_s = 0;
    QString text;  ///< "Width 200.0 µs · interval 4.000 ms (250.0 Hz)"
    bool operator==(const EdgeReading&) const = default;
};

/// The edge nearest to `time_s`, if one is nearer than `reach_s`; else `time_s`.
[[nodiscard]] double snappedToEdge(const std::vector<TraceSpan>& spans, double time_s, double reach_s);
/// The first edge after `time_s` (`direction` 1) or before it (-1); `time_s` where there is none. An edge nearer than
/// `least_s` is the one that the cursor stands on.
[[nodiscard]] double nextEdge(const std::vector<TraceSpan>& spans, double time_s, double direction, double least_s);
/// From the onset to the end of the pulse whose onset is nearest to `time_s`.
[[nodiscard]] std::optional<std::pair<double, double>> pulseNear(const std::vector<TraceSpan>& spans, double time_s);
/// The phase, or the rest between two phases, that `time_s` lies in.
[[nodiscard]] std::optional<EdgeReading> edgesAround(const std::vector<TraceSpan>& spans, double time_s);

}  // namespace tacto::gui
