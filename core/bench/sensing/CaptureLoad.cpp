#include "core/bench/sensing/CaptureLoad.h"

#include <algorithm>
#include <cmath>

#include "core/measure/LoadMeasurement.h"

namespace tacto {

namespace {

/// A current of fewer steps cannot be told from no current (the load-safety check uses the same limit).
constexpr double kMinSteps = 10;

/// Used if an instrument does not state how accurately it stamps its records.
constexpr Instant kUnknownStamp = std::chrono::milliseconds(50);
/// Delay from a write to the onset, in addition to the driver's own waiting.
constexpr Instant kOutputDelay = std::chrono::milliseconds(2);

struct Stretch {
    Instant from, until;
};

Stretch stretchOf(const Capture& capture) {
    const double length_s = capture.rate_hz > 0 ? static_cast<double>(capture.samples()) / capture.rate_hz : 0;
    return {toInstant(Seconds(capture.start_s)), toInstant(Seconds(capture.start_s + length_s))};
}

Instant stampSlack(const Capture& capture) {
    const double stated_s = capture.stampTolerance_s;
    return std::isfinite(stated_s) ? toInstant(Seconds(stated_s)) + kOutputDelay : kUnknownStamp;
}

/// True if both commands should give the same reading.
bool alike(const ProgrammedTrain& a, const ProgrammedTrain& b) {
    constexpr double kSame = 1e-9;
    return std::abs(a.expected - b.expected) <= kSame * std::abs(b.expected) && a.isCheck == b.isCheck;
}

/// True if no pulse of the command could be missed: the record covers its output, and the samples are close enough.
bool mustShow(const Capture& capture, const SourceTraits& source, const ProgrammedTrain& command) {
    constexpr double kSamplesInPhase = 2;
    const auto [from, until] = stretchOf(capture);
    const Instant slack = stampSlack(capture);
    return command.acknowledged && from <= command.from - slack && command.until + slack <= until &&
           capture.rate_hz * Seconds(source.widthMin).count() >= kSamplesInPhase;
}

/// Returns the span of a channel with a known resolution, from least to greatest; nothing if samples are missing.
std::optional<double> mostIn(const CaptureChannel& channel) {
    if (!(channel.lsb > 0) || channel.samples.empty()) return std::nullopt;
    const auto [low, high] = std::minmax_element(channel.samples.begin(), channel.samples.end());
    const double most = static_cast<double>(*high) - static_cast<double>(*low);
    return std::isfinite(most) ? std::optional(most) : std::nullopt;
}

/// Returns the smallest possible |Z| if `current` stays within the last steps of its channel.
std::optional<Ohms> leastImpedance(const Capture& capture, std::size_t voltage, const CaptureChannel& current) {
    const double visible = kMinSteps * current.lsb;
    const auto swing = mostIn(current);
    if (!swing || !(*swing < visible)) return std::nullopt;
    const double amplitude = measureChannel(capture, voltage).amplitude.mean;
    if (!(amplitude > 0)) return std::nullopt;
    return Ohms(amplitude / visible);
}

/// The limit of IEC 60601-2-10 for the deviation of an amplitude.
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

std::optional<ProgrammedTrain> commandShownIn(const Capture& capture, std::span<const ProgrammedTrain> programmed) {
    const auto [from, until] = stretchOf(capture);
    const Instant slack = stampSlack(capture);
    const ProgrammedTrain* shown = nullptr;
    Instant oldest = Instant::max();
    bool full = true;
    for (const auto& command : programmed) {
        full = full && command.until != Instant(0);
        oldest = std::min(oldest, command.from);
        if (std::isnan(command.amplitude) || command.until + slack < from || command.from - slack > until) continue;
        if (shown != nullptr && !(alike(command, *shown))) return std::nullopt;
        if (shown == nullptr || command.from > shown->from) shown = &command;
    }
    // The record begins before the oldest remembered command, so it may show a forgotten one.
    if (shown == nullptr || (full && from < oldest - slack)) return std::nullopt;
    return *shown;
}

std::optional<SeenAmplitude> amplitudeSeenIn(const Capture& capture, const SourceTraits& source,
                                             const ProgrammedTrain& command) {
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    const bool current = source.drive == Drive::Current;
    const auto index = current ? channels->second : channels->first;
    const auto& channel = capture.channels[index];
    const double scale = current ? 1e3 : 1;
    const double expected = command.expected / scale;
    SeenAmplitude seen;
    const auto measured = measureChannel(capture, index);
    const double mean = measured.amplitude.mean, most = measured.amplitude.max;
    // Use the largest pulse if it is further off: one pulse that is too large is enough.
    double amplitude = !(std::abs(mean - expected) > std::abs(most - expected)) ? most : mean;
    const auto swing = mostIn(channel);
    const bool clipped =
        std::ranges::any_of(measured.pulses, [](const PulseMeasurement& pulse) { return pulse.flags.clipped; });
    // Both phases of a pulse are equally large, so the signal swings by twice the amplitude.
    if (clipped && swing && !(amplitude > *swing / 2)) {
        amplitude = *swing / 2;
        if (amplitude < expected) return std::nullopt;
        seen.by = "the oscilloscope shows at least";
    }
    if (!std::isfinite(amplitude)) {
        if (!measured.pulses.empty() || !swing || !mustShow(capture, source, command)) return std::nullopt;
        if (!(kMinSteps * channel.lsb < expected) || !(*swing < expected)) return std::nullopt;
        amplitude = *swing;
    }
    seen.amplitude = scale * amplitude;
    // An unstated accuracy excuses no deviation, so that a fault is found sooner (hazard H3).
    const auto stated = [](double tolerance) { return std::isfinite(tolerance) ? tolerance : 0; };
    seen.uncertainty = scale * ((stated(channel.gainTolerance) + stated(channel.probeTolerance)) * amplitude +
                                stated(channel.offsetTolerance) + channel.linearityTolerance + channel.lsb);
    seen.expected = command.expected;
    seen.programmed = command.amplitude;
    seen.onset = std::isnan(expected) ? toInstant(Seconds(capture.start_s)) : command.onset;
    seen.isCheck = command.isCheck;
    return seen;
}

}  // namespace tacto
