#include "drivers/sciencemode/ReadBack.h"

#include <algorithm>
#include <cmath>

namespace tacto::sciencemode {
namespace {

constexpr double kCoverage = 1.96;  // coverage factor for 95 %
/// Below this share of the commanded current, the circuit is open.
constexpr double kNoCurrent = 0.1;

double sampleAt(const ChannelConfigAck& ack, std::size_t index) noexcept { return ack.samples[index] * kSampleUnit; }

/// Returns the magnitude at the end of the leading phase, from a straight line through the last two samples in it.
std::optional<double> leadingEnd(const ChannelConfigAck& ack, double step_us, double width_us) noexcept {
    const double last = std::ceil(width_us / step_us - 1e-9) - 1;
    if (!(last >= 0) || !(last < static_cast<double>(kSamples))) return std::nullopt;
    const auto index = static_cast<std::size_t>(last);
    const double value = sampleAt(ack, index);
    if (index == 0) return value;
    const double slope = (value - sampleAt(ack, index - 1)) / step_us;
    return std::max(0.0, value + slope * (width_us - last * step_us));
}

/// Returns the sum of the samples in [from, to), or nothing if the samples end earlier.
std::optional<double> chargeIn(const ChannelConfigAck& ack, double step_us, double from_us, double to_us) noexcept {
    if (!(to_us <= step_us * static_cast<double>(kSamples))) return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        const double t = static_cast<double>(i) * step_us;
        if (t >= from_us - 1e-9 && t < to_us - 1e-9) sum += sampleAt(ack, i) * step_us;
    }
    return sum;
}

void judgeBalance(const ChannelConfigAck& ack, const PulsePlan& plan, double step_us, PulseReading& into) noexcept {
    if (plan.second.count() == 0) return;
    const double secondAt = (plan.leading + plan.gap).count();
    const auto first = chargeIn(ack, step_us, 0, plan.leading.count());
    const auto second = chargeIn(ack, step_us, secondAt, secondAt + plan.second.count());
    if (!first || !second || !(*first > 0) || !(*second > 0)) return;
    const double imbalance = std::abs(*first - *second) / std::max(*first, *second);
    // Each phase has two edges, each uncertain by one step, and a plateau uncertain by one unit.
    const auto relative = [&](double width_us, double charge) {
        const double plateau = charge / width_us;
        return std::hypot(std::sqrt(2.0) * step_us / width_us, kSampleUnit / plateau) / std::sqrt(12.0);
    };
    const double uncertainty =
        kCoverage * std::hypot(relative(plan.leading.count(), *first), relative(plan.second.count(), *second));
    if (!(imbalance > uncertainty)) return;
    into.imbalance = imbalance;
    into.imbalanceUncertainty = uncertainty;
}

SampledPulse samplesOf(const ChannelConfigAck& ack, Micros step) noexcept {
    SampledPulse samples{ack.measurement, step, {}};
    for (std::size_t i = 0; i < kSamples; ++i) samples.magnitudes[i] = static_cast<float>(sampleAt(ack, i));
    return samples;
}

}  // namespace

std::optional<Micros> sampleStep(const ChannelConfigAck& ack, const PulsePlan& plan) noexcept {
    if (!ack.measured || ack.sampleTime_us == 0) return std::nullopt;
    const Micros stated(ack.sampleTime_us);
    if (stated < plan.points.duration()) return stated;
    return stated / static_cast<double>(kSamples);
}

PulseReading readPulse(const ChannelConfigAck& ack, const PulsePlan& plan, Volts compliance) noexcept {
    PulseReading reading;
    if (ack.result == ResultCode::Electrode) reading.electrode = ElectrodeState::Open;
    const auto step = sampleStep(ack, plan);
    const double commanded = plan.amplitude.value();
    if (step) reading.samples = samplesOf(ack, *step);
    if (!step || !(commanded > 0)) return reading;  // an amplitude of 0 gives no measurement
    const auto end = leadingEnd(ack, step->count(), plan.leading.count());
    if (!end) return reading;
    if (ack.measurement == Measurement::Current) {
        reading.amplitude = Milliamps(*end);
        if (*end < kNoCurrent * commanded) reading.electrode = ElectrodeState::Open;
        if (reading.electrode == ElectrodeState::NotMeasured) reading.electrode = ElectrodeState::Ok;
        judgeBalance(ack, plan, step->count(), reading);
    } else if (ack.measurement == Measurement::Voltage) {
        if (*end >= kAtCompliance * compliance.value()) reading.electrode = ElectrodeState::Open;
        if (reading.electrode == ElectrodeState::Open) return reading;  // the current is not the commanded current
        const Ohms impedance(*end / (commanded * 1e-3));
        reading.electrode = impedance < kTouching ? ElectrodeState::Short : ElectrodeState::Ok;
        if (*end > 0) reading.impedance = impedance;  // 0 means below the last digit, not a measurement
    }
    return reading;
}

}  // namespace tacto::sciencemode
