#include "core/encoding/Waveform.h"

#include <algorithm>
#include <cmath>

namespace tacto {
namespace {

/// Adds a rectangle [from, to), in samples of `out`, as each sample's mean.
void addRectangle(std::span<double> out, double from, double to, double level) noexcept {
    const double end = static_cast<double>(out.size());
    from = std::max(from, 0.0);
    to = std::min(to, end);
    if (!(from < to)) return;
    auto k = static_cast<std::size_t>(from);
    const auto last = static_cast<std::size_t>(to);
    if (k == last) {
        out[k] += level * (to - from);
        return;
    }
    out[k] += level * (static_cast<double>(k + 1) - from);
    for (++k; k < last; ++k) out[k] += level;
    if (last < out.size()) out[last] += level * (to - static_cast<double>(last));
}

}  // namespace

Result<void> synthesize(const PulseTrain& train, Hertz sampleRate, std::span<double> out, Seconds start) {
    if (auto valid = validate(train); !valid) return valid;
    const double fs = sampleRate.value();
    if (!(fs > 0) || !std::isfinite(fs)) {
        return fail(ErrorCode::InvalidArgument, "sampling rate {} Hz is not a finite number above 0", fs);
    }
    if (!std::isfinite(start.count()))
        return fail(ErrorCode::InvalidArgument, "a start of {} s is not finite", start.count());
    std::fill(out.begin(), out.end(), 0.0);

    const double windowEnd = start.count() + static_cast<double>(out.size()) / fs;
    const double period = 1 / train.rate.value();
    const double pulseLength = train.pulseDuration().count();
    // Only the pulses that reach into the window.
    const double first = std::max(0.0, std::floor((start.count() - pulseLength) / period));
    const double last = std::min(static_cast<double>(train.pulses - 1), std::floor(windowEnd / period));
    const PulseSegments pulse = segmentsOf(train, GapState::HoldsZero);
    for (double p = first; p <= last; p += 1) {
        double at = p * period - start.count();
        for (const auto& segment : pulse.span()) {
            if (segment.start != 0) addRectangle(out, at * fs, (at + segment.duration_s) * fs, segment.start);
            at += segment.duration_s;
        }
    }
    return {};
}

}  // namespace tacto
