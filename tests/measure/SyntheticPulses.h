// SyntheticPulses.h - makes records in which every edge is known to a fraction of a sample: a formula gives each
// sample, so the truth needs no algorithm.
//
// A phase is the difference of two equal step responses, width_s apart: its charge is level × width and its 50 % points
// are width_s apart for any shape of edge, once the edges have settled (see MeasurementGrid.h, truthOf()).
//
// Thread-safety: pure functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/Random.h"
#include "core/measure/Capture.h"

namespace tacto::test {

/// One phase: 50 % points at onset and onset + width, and straight edges that last edge_s from 0 to 100 %.
struct SyntheticPhase {
    double onset_s = 0;
    double width_s = 200e-6;
    double level = 40;
    double edge_s = 2e-6;
    double droop = 0;      ///< fraction lost over the width, linearly
    double overshoot = 0;  ///< as a fraction; decays with a time constant of a tenth of the width
    // At most one of these replaces the straight edges:
    double tau_s = 0;    ///< time constant of exponential edges, as with a resistor and a capacitor in parallel
    double ringing = 0;  ///< first overshoot of a damped oscillation, as a fraction
    double ringingPeriod_s = 20e-6;
};

/// The edge of a phase: rises from 0 to 1 and passes 0.5 at time 0.
class StepResponse {
public:
    explicit StepResponse(const SyntheticPhase& p) : edge_s_(p.edge_s), tau_s_(p.tau_s) {
        if (p.ringing > 0) {
            const double log = -std::log(p.ringing);
            const double zeta = log / std::hypot(std::numbers::pi, log);
            omega_ = 2 * std::numbers::pi / p.ringingPeriod_s;
            sigma_ = omega_ * zeta / std::sqrt(1 - zeta * zeta);
            double early = 0, late = 0.5 * p.ringingPeriod_s;
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (early + late);
                (ringing(middle) < 0.5 ? early : late) = middle;
            }
            delay_s_ = early;
        } else if (tau_s_ > 0) {
            delay_s_ = tau_s_ * std::numbers::ln2;
        }
    }
    [[nodiscard]] double at(double since) const {
        if (omega_ > 0) return ringing(since + delay_s_);
        if (tau_s_ > 0) return since + delay_s_ > 0 ? 1 - std::exp(-(since + delay_s_) / tau_s_) : 0;
        return std::clamp(since / edge_s_ + 0.5, 0.0, 1.0);
    }
    /// Times from the 50 % point back to the start of the edge, and on to where it differs from 1 by less than 1e-12.
    [[nodiscard]] double before_s() const { return omega_ > 0 || tau_s_ > 0 ? delay_s_ : 0.5 * edge_s_; }
    [[nodiscard]] double after_s() const { return omega_ > 0 ? 28 / sigma_ : tau_s_ > 0 ? 28 * tau_s_ : 0.5 * edge_s_; }

private:
    [[nodiscard]] double ringing(double t) const {
        if (!(t > 0)) return 0;
        return 1 - std::exp(-sigma_ * t) * (std::cos(omega_ * t) + sigma_ / omega_ * std::sin(omega_ * t));
    }
    double edge_s_;
    double tau_s_;
    double omega_ = 0;
    double sigma_ = 0;
    double delay_s_ = 0;
};

inline double valueAt(const SyntheticPhase& p, const StepResponse& step, double t) {
    const double since = t - p.onset_s;
    const double shape =
        1 - p.droop * (since / p.width_s - 0.6) + (since > 0 ? p.overshoot * std::exp(-since / (0.03 * p.width_s)) : 0);
    return p.level * shape * (step.at(since) - step.at(since - p.width_s));
}

struct SyntheticRecord {
    double rate_hz = 2e6;
    double start_s = 0;
    std::size_t samples = 20'000;
    double offset = 0;
    double noise = 0;
    double lsb = 0;
    unsigned seed = 1;
    double slope_per_s = 0;  ///< drift; zero in the middle of the record
    double hum = 0;          ///< amplitude of a sine at hum_hz
    double hum_hz = 50;
    double hum_rad = 0;  ///< phase of the hum at time 0
    double range = 0;    ///< samples are clipped at ± this, and the channel states it; 0 = unlimited and unknown
};

inline Capture recordOf(const std::vector<SyntheticPhase>& phases, const SyntheticRecord& r = {}) {
    std::vector<double> values(r.samples);
    const double middle = r.start_s + 0.5 * static_cast<double>(r.samples) / r.rate_hz;
    const auto timeOf = [&](std::size_t i) { return r.start_s + static_cast<double>(i) / r.rate_hz; };
    for (std::size_t i = 0; i < r.samples; ++i) {
        values[i] = r.offset + r.slope_per_s * (timeOf(i) - middle);
        if (r.hum > 0) values[i] += r.hum * std::sin(2 * std::numbers::pi * r.hum_hz * timeOf(i) + r.hum_rad);
    }
    for (const auto& phase : phases) {
        const StepResponse step(phase);
        const double last = static_cast<double>(r.samples);
        const auto sampleAt = [&](double t) {
            return static_cast<std::size_t>(std::clamp((t - r.start_s) * r.rate_hz, 0.0, last));
        };
        const std::size_t end = std::min(r.samples, sampleAt(phase.onset_s + phase.width_s + step.after_s()) + 2);
        for (std::size_t i = sampleAt(phase.onset_s - step.before_s()); i < end; ++i) {
            values[i] += valueAt(phase, step, timeOf(i));
        }
    }
    Capture capture;
    capture.rate_hz = r.rate_hz;
    capture.start_s = r.start_s;
    capture.timeBaseTolerance = 0;  // stated to be exact
    CaptureChannel channel;
    channel.name = "voltage";
    channel.unit = "V";
    channel.lsb = r.lsb;
    channel.gainTolerance = channel.probeTolerance = 0;
    channel.low = -r.range;
    channel.high = r.range;
    channel.samples.reserve(r.samples);
    Random random(r.seed, "record");
    for (double v : values) {
        if (r.noise > 0) v += r.noise * random.normal();
        if (r.range > 0) v = std::clamp(v, -r.range, r.range);
        if (r.lsb > 0) v = r.lsb * std::round(v / r.lsb);
        channel.samples.push_back(static_cast<float>(v));
    }
    capture.channels.push_back(std::move(channel));
    return capture;
}

/// Returns a symmetric biphasic pulse; the gap is measured from 50 % to 50 %.
inline std::vector<SyntheticPhase> biphasic(double onset_s, double level = 40, double width_s = 200e-6,
                                            double gap_s = 100e-6, double edge_s = 2e-6) {
    return {{onset_s, width_s, level, edge_s}, {onset_s + width_s + gap_s, width_s, -level, edge_s}};
}

inline void append(std::vector<SyntheticPhase>& phases, const std::vector<SyntheticPhase>& more) {
    phases.insert(phases.end(), more.begin(), more.end());
}

}  // namespace tacto::test
