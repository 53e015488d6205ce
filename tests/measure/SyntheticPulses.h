// SyntheticPulses.h - records whose every edge is known to a fraction of a sample: trapezoids evaluated where the
// samples lie, so that the truth needs no algorithm.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/Random.h"
#include "core/measure/Capture.h"

namespace tacto::test {

/// One phase: 50 % points at onset and onset + width, straight edges of the given 0 to 100 % duration.
struct SyntheticPhase {
    double onset_s = 0;
    double width_s = 200e-6;
    double level = 40;
    double edge_s = 2e-6;
    double droop = 0;      ///< fraction lost over the width, in a straight line
    double overshoot = 0;  ///< fraction, decaying with a tenth of the width
};

struct SyntheticRecord {
    double rate_hz = 2e6;
    double start_s = 0;
    std::size_t samples = 20'000;
    double offset = 0;
    double noise = 0;
    double lsb = 0;
    unsigned seed = 1;
};

inline double valueAt(const SyntheticPhase& p, double t) {
    const double since = t - p.onset_s;
    const double up = std::clamp(since / p.edge_s + 0.5, 0.0, 1.0);
    const double down = std::clamp((since - p.width_s) / p.edge_s + 0.5, 0.0, 1.0);
    const double shape =
        1 - p.droop * (since / p.width_s - 0.6) + (since > 0 ? p.overshoot * std::exp(-since / (0.03 * p.width_s)) : 0);
    return p.level * shape * (up - down);
}

inline Capture recordOf(const std::vector<SyntheticPhase>& phases, const SyntheticRecord& r = {}) {
    Capture capture;
    capture.rate_hz = r.rate_hz;
    capture.start_s = r.start_s;
    CaptureChannel channel;
    channel.name = "voltage";
    channel.unit = "V";
    channel.lsb = r.lsb;
    Random random(r.seed, "record");
    for (std::size_t i = 0; i < r.samples; ++i) {
        const double t = r.start_s + static_cast<double>(i) / r.rate_hz;
        double v = r.offset;
        for (const auto& phase : phases) v += valueAt(phase, t);
        if (r.noise > 0) v += r.noise * random.normal();
        if (r.lsb > 0) v = r.lsb * std::round(v / r.lsb);
        channel.samples.push_back(static_cast<float>(v));
    }
    capture.channels.push_back(std::move(channel));
    return capture;
}

/// Symmetric biphasic pulse: both phases, the gap from 50 % to 50 %.
inline std::vector<SyntheticPhase> biphasic(double onset_s, double level = 40, double width_s = 200e-6,
                                            double gap_s = 100e-6, double edge_s = 2e-6) {
    return {{onset_s, width_s, level, edge_s}, {onset_s + width_s + gap_s, width_s, -level, edge_s}};
}

inline void append(std::vector<SyntheticPhase>& phases, const std::vector<SyntheticPhase>& more) {
    phases.insert(phases.end(), more.begin(), more.end());
}

}  // namespace tacto::test
