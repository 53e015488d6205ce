// LoadCaptures.h - makes captures of a train into a resistor with known truth, as an ideal instrument would.
//
// Thread-safety: pure functions.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/analysis/load_safety/LoadReading.h"
#include "core/base/Random.h"

namespace tacto::test {

struct LoadTruth {
    double volts = 40;
    double ohms = 500;
    double width_s = 200e-6;
    double gap_s = 100e-6;
    double interval_s = 0.5;
    int pulses = 1;
    double train_hz = 100;  ///< pulse rate within the train
    double second = 1;      ///< amplitude of the second phase / leading phase
    double rate_hz = 10e6;
    double gain_v = 1, gain_i = 1;      ///< gain errors of the instrument
    double offset_v = 0, offset_a = 0;  ///< offset errors of the instrument
    double gainTolerance = 0.005;
    double shuntTolerance = 0;
    double timeBaseTolerance = 0;
    double timeBase = 1;     ///< what the instrument reads for one second
    double noise = 0;        ///< r.m.s., as a share of the range
    double scatter = 0;      ///< relative scatter of the trains' amplitudes
    std::uint64_t seed = 1;  ///< seed for noise and scatter
    int bits = 12;           ///< resolution; the range is 1.5 times the peak
};

/// Returns `trains` captures, one per train. Edges last 100 ns, as with a fast source.
[[nodiscard]] inline std::vector<Capture> loadCaptures(const LoadTruth& truth, int trains = 2) {
    std::vector<Capture> out;
    const double edge = 100e-9, before = 120e-6;
    const double end = before + (truth.pulses - 1) / truth.train_hz + 2 * truth.width_s + truth.gap_s + 150e-6;
    Random random(truth.seed, "load captures");
    double shift = 0;  // position of the train's start between two samples
    const auto level = [&](double stated) {
        const double t = stated / truth.timeBase - shift;
        // A trapezoid with the phase's width at half height.
        const auto phase = [&](double from) {
            const double x = t - from;
            if (x < 0 || x > truth.width_s + edge) return 0.0;
            if (x < edge) return x / edge;
            return x > truth.width_s ? 1 - (x - truth.width_s) / edge : 1.0;
        };
        double sum = 0;
        for (int pulse = 0; pulse < truth.pulses; ++pulse) {
            const double onset = before + pulse / truth.train_hz;
            sum += phase(onset) - truth.second * phase(onset + truth.width_s + truth.gap_s);
        }
        return truth.volts * sum;
    };
    for (int k = 0; k < trains; ++k) {
        Capture capture;
        capture.rate_hz = truth.rate_hz;
        capture.start_s = k * truth.interval_s * truth.timeBase;
        capture.timeBaseTolerance = truth.timeBaseTolerance;
        capture.stampTolerance_s = 0;
        const double strength = 1 + truth.scatter * random.normal();
        if (truth.noise > 0) shift = random.uniform() / truth.rate_hz;
        capture.trigger_s = capture.start_s + before;
        CaptureChannel v, i;
        v.name = "voltage";
        v.unit = "V";
        i.name = "current";
        i.unit = "A";
        v.high = 1.5 * truth.volts;
        i.high = 1.5 * truth.volts / truth.ohms;
        for (auto* channel : {&v, &i}) {
            channel->low = -channel->high;
            channel->lsb = 2 * channel->high / std::ldexp(1, truth.bits);
            channel->gainTolerance = truth.gainTolerance;
            channel->probeTolerance = channel == &i ? truth.shuntTolerance : 0;
        }
        const auto read = [&](double x, const CaptureChannel& channel) {
            if (truth.noise > 0) x += truth.noise * channel.high * random.normal();
            return static_cast<float>(std::round(x / channel.lsb) * channel.lsb);
        };
        for (double t = 0; t < end; t += 1 / truth.rate_hz) {
            const double volts = strength * level(t);
            v.samples.push_back(read(truth.gain_v * volts + truth.offset_v, v));
            i.samples.push_back(read(truth.gain_i * volts / truth.ohms + truth.offset_a, i));
        }
        capture.channels = {v, i};
        out.push_back(std::move(capture));
    }
    return out;
}

}  // namespace tacto::test
