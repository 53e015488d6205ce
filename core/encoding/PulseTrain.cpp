#include "core/encoding/PulseTrain.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

double inSeconds(Micros t) noexcept { return Seconds(t).count(); }

double secondWidth(const PulseTrain& train) noexcept {
    switch (train.shape) {
        case PulseShape::SymmetricBiphasic:
            return inSeconds(train.phaseWidth);
        case PulseShape::AsymmetricBiphasic:
            return inSeconds(train.phaseWidth) * train.rechargeRatio;
        case PulseShape::Monophasic:
            break;
    }
    return 0;
}

double gapOf(const PulseTrain& train) noexcept {
    return train.shape == PulseShape::Monophasic ? 0.0 : inSeconds(train.interPhaseGap);
}

}  // namespace

double siValue(const Amplitude& a) noexcept {
    if (const auto* volts = std::get_if<Volts>(&a)) return volts->value();
    return std::get<Milliamps>(a).value() * 1e-3;
}

Seconds PulseTrain::duration() const noexcept { return Seconds(pulses / rate.value()); }

Seconds PulseTrain::pulseDuration() const noexcept {
    return Seconds(inSeconds(phaseWidth) + gapOf(*this) + secondWidth(*this));
}

Seconds PulseTrain::outputDuration() const noexcept { return Seconds((pulses - 1) / rate.value()) + pulseDuration(); }

Result<void> validate(const PulseTrain& train) {
    const double amplitude = std::visit([](auto a) { return a.value(); }, train.amplitude);
    const auto refused = [](std::string_view what, double value, std::string_view unit, std::string_view accepted) {
        return invalid("{} {} {} is not {}", what, value, unit, accepted);
    };
    const auto finite = [](double x, bool atLeast) { return std::isfinite(x) && atLeast; };
    if (!finite(amplitude, amplitude >= 0)) {
        return refused("amplitude", amplitude, amplitudeUnit(train.amplitude), "a finite number of 0 or more");
    }
    switch (train.shape) {
        case PulseShape::SymmetricBiphasic:
        case PulseShape::AsymmetricBiphasic:
        case PulseShape::Monophasic:
            break;
        default:
            return refused("pulse shape", static_cast<int>(train.shape), "", "one of the three shapes");
    }
    if (train.polarity != Polarity::Positive && train.polarity != Polarity::Negative) {
        return refused("polarity", static_cast<int>(train.polarity), "", "positive or negative");
    }
    const double width = train.phaseWidth.count();
    if (!finite(width, width > 0)) return refused("phase width", width, "µs", "a finite number above 0");
    const double gap = train.interPhaseGap.count();
    if (!finite(gap, gap >= 0)) return refused("inter-phase gap", gap, "µs", "a finite number of 0 or more");
    if (train.shape == PulseShape::AsymmetricBiphasic && !finite(train.rechargeRatio, train.rechargeRatio > 1)) {
        return refused("recharge ratio", train.rechargeRatio, "", "a finite number above 1");
    }
    if (train.pulses < 1) return invalid("{} pulses are not 1 or more", train.pulses);
    const double rate = train.rate.value();
    if (!finite(rate, rate > 0)) return refused("intra-train rate", rate, "Hz", "a finite number above 0");
    // Tolerance of 1e-9: a pulse of 0.1 ms must fit at 10 kHz, although neither value is exact in binary.
    const double pulse = train.pulseDuration().count();
    if (!(pulse <= (1 + 1e-9) / rate)) {
        return invalid("a pulse of {:.6g} µs does not fit into its period of {:.6g} µs (1/{} Hz)", pulse * 1e6,
                       1e6 / rate, rate);
    }
    return {};
}

PulseSegments segmentsOf(const PulseTrain& train, GapState gap) noexcept {
    PulseSegments segments;
    const Drive drive = isCurrent(train.amplitude) ? Drive::Current : Drive::Voltage;
    const double level = siValue(train.amplitude) * (train.polarity == Polarity::Positive ? 1 : -1);
    segments.items[segments.count++] = {drive, level, level, inSeconds(train.phaseWidth)};
    if (train.shape == PulseShape::Monophasic) return segments;
    if (gapOf(train) > 0) segments.items[segments.count++] = restOf(gap, Seconds(gapOf(train)));
    const double width = secondWidth(train);
    const double second =
        train.shape == PulseShape::AsymmetricBiphasic ? -level / train.rechargeRatio : -level;  // equal charge
    segments.items[segments.count++] = {drive, second, second, width};
    return segments;
}

DriveSegment restOf(GapState gap, Seconds duration) noexcept {
    return {gap == GapState::HoldsZero ? Drive::Voltage : Drive::HighImpedance, 0, 0, duration.count()};
}

Seconds restBetweenPulses(const PulseTrain& train) noexcept {
    const double rest = 1 / train.rate.value() - train.pulseDuration().count();
    return Seconds(rest > 0 ? rest : 0.0);
}

namespace {

/// Adds the rectangle [from, to), given in samples of `out`, as a mean value per sample.
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
        return invalid("sampling rate {} Hz is not a finite number above 0", fs);
    }
    if (!std::isfinite(start.count())) return invalid("a start of {} s is not finite", start.count());
    std::fill(out.begin(), out.end(), 0.0);

    const double windowEnd = start.count() + static_cast<double>(out.size()) / fs;
    const double period = 1 / train.rate.value();
    const double pulseLength = train.pulseDuration().count();
    // Use only the pulses that overlap the window.
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
