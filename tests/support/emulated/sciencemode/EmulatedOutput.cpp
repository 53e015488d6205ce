#include "tests/support/emulated/sciencemode/EmulatedOutput.h"

#include <algorithm>
#include <cmath>

namespace tacto::sciencemode {
namespace {

constexpr double kSampleUnit = 0.01;  // mA or V
constexpr double kSupply_V = 150;

DriveSegment segmentOf(const Point& point) noexcept {
    const double level = point.current.value() * 1e-3;
    const Drive drive = level == 0 ? Drive::HighImpedance : Drive::Current;
    return {drive, level, level, Seconds(point.time).count()};
}

/// Returns which part of a pulse a point belongs to: points before the first pause lead, opposite points recharge.
PulsePart partOf(const Points& points, std::size_t index) noexcept {
    const double level = points.items[index].current.value();
    const double lead = points.items[0].current.value();
    if (level == 0) return PulsePart::Gap;
    if (level != lead) return PulsePart::SecondPhase;
    for (std::size_t i = 0; i < index; ++i) {
        if (points.items[i].current.value() != lead) return PulsePart::Rest;  // a later pulse of the train
    }
    return PulsePart::LeadingPhase;
}

}  // namespace

void EmulatedOutput::fit(const Load& load, Instant now) {
    load_ = load;
    fitted_ = now;
    capacitor_V_ = 0;
}

const EmittedPulse& EmulatedOutput::play(const Points& points, int channel, bool midLevel, Instant onset,
                                         ChannelConfigAck* into, bool stepIsTotal) {
    const double duration_us = points.duration().count();
    std::array<DriveSegment, kMaxPoints> segments;
    for (std::size_t i = 0; i < points.count; ++i) segments[i] = segmentOf(points.items[i]);
    const SourceLimits limits{compliance_.value(), kMaxCurrent_mA * 1e-3};
    auto circuit = circuitAt(load_, toSeconds(onset - fitted_), {segments.data(), points.count}, limits);
    circuit.open = circuit.open || isOpen(onset);

    PulseResponse response(circuit, limits, capacitor_V_);
    if (!pulses_.empty() && onset > pulses_.back().end) {
        // The voltage left on the load decays until this pulse.
        static_cast<void>(
            response.add({Drive::HighImpedance, 0, 0, toSeconds(onset - pulses_.back().end)}, PulsePart::Rest));
        response.restart();
    }
    const auto step_us = std::max(1U, static_cast<unsigned>(std::ceil(duration_us / static_cast<double>(kSamples))));
    std::size_t sample = 0;
    double begin_us = 0;
    for (std::size_t i = 0; i < points.count; ++i) {
        const auto made = response.add(segments[i], partOf(points, i));
        const double end_us = begin_us + points.items[i].time.count();
        for (; into != nullptr && sample < kSamples && static_cast<double>(sample * step_us) < end_us; ++sample) {
            const double t_s = (static_cast<double>(sample * step_us) - begin_us) * 1e-6;
            double value = kSupply_V;
            if (into->measurement == Measurement::Current) value = std::abs(made.current(t_s)) * 1e3;
            if (into->measurement == Measurement::Voltage) value = std::abs(made.voltage(t_s));
            into->samples[sample] =
                static_cast<std::uint16_t>(std::clamp(std::round(value / kSampleUnit), 0.0, 65535.0));
        }
        begin_us = end_us;
    }
    if (into != nullptr) {
        std::fill(into->samples.begin() + static_cast<std::ptrdiff_t>(sample), into->samples.end(), std::uint16_t{0});
        into->sampleTime_us = static_cast<std::uint16_t>(stepIsTotal ? step_us * kSamples : step_us);
        into->measured = into->measurement != Measurement::None;
    }
    capacitor_V_ = response.capacitorVoltage();

    EmittedPulse pulse;
    pulse.onset = onset;
    pulse.end = onset + toInstant(Seconds(points.duration()));
    pulse.channel = channel;
    pulse.midLevel = midLevel;
    pulse.points = points;
    pulse.totals = response.totals();
    if (pulses_.size() == kKept) pulses_.pop_front();
    pulses_.push_back(pulse);
    return pulses_.back();
}

void EmulatedOutput::cut(Instant now) noexcept {
    if (!active(now)) return;
    pulses_.back().end = now;
    pulses_.back().cut = true;
}

bool EmulatedOutput::active(Instant now) const noexcept {
    return !pulses_.empty() && now >= pulses_.back().onset && now < pulses_.back().end;
}

}  // namespace tacto::sciencemode
