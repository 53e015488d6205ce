#include "core/analysis/load_safety/LoadTrace.h"

#include <algorithm>
#include <cmath>

#include "core/measure/Clipping.h"

namespace tacto {

std::size_t LoadTrace::indexAt(double t_s) const noexcept {
    const double position = std::ceil((t_s - start_s) / dt - 1e-6);
    if (!(position > 0)) return 0;
    return std::min(static_cast<std::size_t>(position), size());
}

bool LoadTrace::clippedNear(std::size_t i, std::size_t aside) const noexcept {
    const auto limits = clipLimits(*channel);
    if (!limits) return false;
    const std::size_t from = i > aside ? i - aside : 0, to = std::min(size(), i + aside + 1);
    for (std::size_t k = from; k < to; ++k) {
        if (limits->reachedBy(static_cast<double>(channel->samples[k]))) return true;
    }
    return false;
}

std::optional<LoadTrace> traceOf(const Capture& capture, std::string_view name, double onset_s) {
    const auto* channel = channelOf(capture, name);
    if (channel == nullptr || !(capture.rate_hz > 0)) return std::nullopt;
    LoadTrace trace;
    trace.channel = channel;
    trace.dt = 1 / capture.rate_hz;
    trace.start_s = capture.start_s;
    const auto limits = clipLimits(*channel);
    for (const float sample : channel->samples) {
        if (!std::isfinite(sample)) return std::nullopt;
        if (limits && limits->reachedBy(static_cast<double>(sample))) trace.clipped = true;
    }
    // Leave out the last tenth before the onset, because an edge begins before it reaches half its height.
    const double before = 0.9 * (onset_s - capture.start_s) * capture.rate_hz;
    if (!(before >= 8)) return std::nullopt;
    trace.quiet = std::min(static_cast<std::size_t>(before), channel->samples.size());
    const auto n = static_cast<double>(trace.quiet);
    double sum = 0;
    for (std::size_t i = 0; i < trace.quiet; ++i) sum += static_cast<double>(channel->samples[i]);
    trace.baseline = sum / n;
    double squares = 0;
    for (std::size_t i = 0; i < trace.quiet; ++i) squares += trace.at(i) * trace.at(i);
    trace.noise = std::sqrt(squares / n);
    return trace;
}

TraceSums sumsOf(const LoadTrace& trace) {
    TraceSums sums;
    double last = 0;
    for (std::size_t i = trace.quiet; i < trace.size(); ++i) {
        const double x = trace.at(i);
        if (std::abs(x) > sums.peak) {
            sums.peak = std::abs(x);
            // The edge up to the peak is as steep as the source; the smaller step bounds how high a hidden peak is.
            const double next = i + 1 < trace.size() ? trace.at(i + 1) : x;
            sums.step = std::min(std::abs(x - last), std::abs(next - x));
        }
        sums.integral += x * trace.dt;
        sums.magnitude += std::abs(x) * trace.dt;
        sums.squares += x * x * trace.dt;
        last = x;
    }
    const double seconds = static_cast<double>(trace.size() - trace.quiet) * trace.dt;
    sums.squares = std::max(0.0, sums.squares - trace.noise * trace.noise * seconds);  // subtract the noise's share
    sums.magnitude = std::max(0.0, sums.magnitude - 0.8 * trace.noise * seconds);  // mean |noise| is 0.8 of its s.d.
    return sums;
}

double integralOf(const LoadTrace& trace, double from_s, double to_s) {
    double sum = 0;
    for (std::size_t i = trace.indexAt(from_s), end = trace.indexAt(to_s); i < end; ++i) sum += trace.at(i) * trace.dt;
    return sum;
}

double meanOf(const LoadTrace& trace, double from_s, double to_s) {
    const std::size_t from = trace.indexAt(from_s), to = trace.indexAt(to_s);
    if (from >= to) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += trace.at(i);
    return sum / static_cast<double>(to - from);
}

double lineAt(const LoadTrace& trace, double from_s, double to_s, double at_s) {
    const std::size_t from = trace.indexAt(from_s), to = trace.indexAt(to_s);
    if (to < from + 2) return std::numeric_limits<double>::quiet_NaN();
    const double mid = trace.start_s + 0.5 * static_cast<double>(from + to - 1) * trace.dt;
    double sum = 0, along = 0, squares = 0;
    for (std::size_t i = from; i < to; ++i) {
        const double t = trace.start_s + static_cast<double>(i) * trace.dt - mid;
        sum += trace.at(i);
        along += trace.at(i) * t;
        squares += t * t;
    }
    return sum / static_cast<double>(to - from) + along / squares * (at_s - mid);
}

double energyOf(const LoadTrace& voltage, const LoadTrace& current) {
    const std::size_t first = std::max(voltage.quiet, current.quiet);
    const std::size_t count = std::min(voltage.size(), current.size());
    double sum = 0;
    for (std::size_t k = first; k < count; ++k) sum += voltage.at(k) * current.at(k) * voltage.dt;
    return sum;
}

}  // namespace tacto
