#include "core/bench/CaptureLoad.h"

#include <algorithm>
#include <cmath>

#include "core/measure/LoadMeasurement.h"

namespace tacto {

namespace {

/// Below this a current is not distinguished from none (the limit of the load-safety check too).
constexpr double kMinSteps = 10;

/// The least that |Z| can be where `current` stays within its channel's last steps.
std::optional<Ohms> leastImpedance(const Capture& capture, std::size_t voltage, const CaptureChannel& current) {
    const double visible = kMinSteps * current.lsb;
    if (!(visible > 0) || current.samples.empty()) return std::nullopt;
    const auto [low, high] = std::minmax_element(current.samples.begin(), current.samples.end());
    const double swing = static_cast<double>(*high) - static_cast<double>(*low);
    if (!(swing < visible)) return std::nullopt;
    const double amplitude = measureChannel(capture, voltage).amplitude.mean;
    if (!(amplitude > 0)) return std::nullopt;
    return Ohms(amplitude / visible);
}

/// As IEC 60601-2-10 asks of an amplitude.
constexpr double kMaxOff = 0.20;

}  // namespace

Result<Ohms> loadConfirmedBy(const Capture& capture, const PulseTrain& commanded) {
    const auto channels = loadChannels(capture);
    if (!channels) {
        return fail(ErrorCode::NotArmed,
                    "the check pulse is not confirmed: the oscilloscope needs a channel in V and one in A");
    }
    const bool current = isCurrent(commanded.amplitude);
    const double wanted = siValue(commanded.amplitude);
    const auto shown = measureChannel(capture, current ? channels->second : channels->first);
    if (shown.measuredPulses == 0) {
        return fail(ErrorCode::NotArmed, "the check pulse is not confirmed: the oscilloscope shows no pulse");
    }
    const double off = std::abs(shown.amplitude.mean - wanted);
    const double uncertainty = std::isfinite(shown.uncertainty.amplitude) ? kCoverage * shown.uncertainty.amplitude : 0;
    if (!(off <= kMaxOff * wanted + uncertainty)) {
        return fail(ErrorCode::NotArmed,
                    "the check pulse is not confirmed: {:.3g} {} was commanded and the oscilloscope shows {:.3g} {}",
                    wanted, shown.unit, shown.amplitude.mean, shown.unit);
    }
    const auto load = measureLoad(capture, channels->first, channels->second);
    if (!load || !(load->load_ohm.mean > 0)) {
        return fail(ErrorCode::NotArmed,
                    "the check pulse is not confirmed: the oscilloscope shows no current, or more than its range");
    }
    return Ohms(load->load_ohm.mean);
}

std::optional<SeenLoad> loadSeenIn(const Capture& capture) {
    if (capture.untriggered || !std::isfinite(capture.trigger_s)) return std::nullopt;
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    const Instant at = toInstant(Seconds(capture.trigger_s));
    const auto load = measureLoad(capture, channels->first, channels->second);
    if (load && load->load_ohm.mean > 0) return SeenLoad{Ohms(load->load_ohm.mean), false, at};
    const auto least = leastImpedance(capture, channels->first, capture.channels[channels->second]);
    if (!least) return std::nullopt;
    return SeenLoad{*least, true, at};
}

std::optional<SeenAmplitude> amplitudeSeenIn(const Capture& capture, Drive drive) {
    if (capture.untriggered || !std::isfinite(capture.trigger_s)) return std::nullopt;
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    const bool current = drive == Drive::Current;
    const auto index = current ? channels->second : channels->first;
    const double amplitude = measureChannel(capture, index).amplitude.mean;
    if (!std::isfinite(amplitude)) return std::nullopt;
    const auto& channel = capture.channels[index];
    const double scale = current ? 1e3 : 1;
    SeenAmplitude seen;
    seen.amplitude = scale * amplitude;
    // What the instrument does not state excuses nothing: a fault is then found sooner (hazard H3).
    const auto stated = [](double tolerance) { return std::isfinite(tolerance) ? tolerance : 0; };
    seen.uncertainty = scale * ((stated(channel.gainTolerance) + stated(channel.probeTolerance)) * amplitude +
                                stated(channel.offsetTolerance) + channel.linearityTolerance + channel.lsb);
    seen.onset = toInstant(Seconds(capture.trigger_s));
    return seen;
}

}  // namespace tacto
