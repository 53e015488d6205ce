#include "core/encoding/Encoder.h"

#include <algorithm>
#include <cmath>

namespace tacto {
namespace {
bool isUnit(double x) noexcept { return x >= 0 && x <= 1; }
}  // namespace

Encoder::Encoder(const EncodingProfile& profile) : profile_(profile) {}

Result<Command> Encoder::encode(double roughness, std::optional<double> pressure) const {
    if (!isUnit(roughness)) return invalid("roughness R {} is outside 0 to 1", roughness);
    const double P = pressure.value_or(0.0);
    if (!isUnit(P)) return invalid("pressure P {} is outside 0 to 1", P);
    const bool swapped = profile_.assignment == Assignment::Swapped;
    const double forAmplitude = swapped ? P : roughness;
    const double forInterval = swapped ? roughness : P;
    return Command{
        Volts(profile_.amplitudeCurve.at(forAmplitude, profile_.amplitudeMin.value(), profile_.amplitudeMax.value())),
        Seconds(profile_.intervalCurve.at(forInterval, profile_.intervalMax.count(), profile_.intervalMin.count()))};
}

Command Encoder::limited(const Command& last, const Command& wanted, Seconds sinceLast) const noexcept {
    Command result = wanted;
    if (profile_.amplitudeSlew_V_per_s > 0) {
        const double most = profile_.amplitudeSlew_V_per_s * std::max(0.0, sinceLast.count());
        result.amplitude =
            Volts(std::clamp(wanted.amplitude.value(), last.amplitude.value() - most, last.amplitude.value() + most));
    }
    const auto within = [](double value, double before, double ratio) {
        return ratio > 1 && before > 0 ? std::clamp(value, before / ratio, before * ratio) : value;
    };
    result.amplitude = Volts(within(result.amplitude.value(), last.amplitude.value(), profile_.amplitudeRatioPerTrain));
    result.interval = Seconds(within(wanted.interval.count(), last.interval.count(), profile_.intervalRatioPerTrain));
    return result;
}

double Encoder::massagerIntensity(Volts amplitude) const noexcept {
    const double intensity = amplitude.value() / profile_.amplitudeMax.value();
    return intensity > 0 ? std::min(intensity, 1.0) : 0.0;  // no output for NaN
}

PulseTrain voltageTrain(const EncodingProfile& profile, Volts amplitude) noexcept {
    PulseTrain train = profile.train;
    train.amplitude = amplitude;
    return train;
}

Result<Volts> heldAmplitude(Hold hold, Volts amplitude, std::optional<Ohms> armed, std::optional<Ohms> now) {
    if (hold == Hold::Voltage) return amplitude;
    if (!armed || !now) {
        return fail(ErrorCode::NotArmed,
                    "the profile holds the {} constant and no impedance was measured; a stimulator that reads it back, "
                    "an oscilloscope, "
                    "or hold \"voltage\", is expected",
                    nameOf(hold));
    }
    const double ratio = now->value() / armed->value();
    if (!(ratio > 0) || !std::isfinite(ratio)) {
        return invalid("an impedance of {} ohm after {} ohm; finite ones above 0 are needed", now->value(),
                       armed->value());
    }
    constexpr double kMaxRatio = 2;
    if (!(ratio <= kMaxRatio && ratio >= 1 / kMaxRatio)) {
        return fail(
            ErrorCode::LimitExceeded,
            "the impedance went from {:.4g} ohm when armed to {:.4g} ohm; the {} is held up to twice or half of it",
            armed->value(), now->value(), nameOf(hold));
    }
    return amplitude * (hold == Hold::Charge ? ratio : std::sqrt(ratio));
}

Result<PulseTrain> currentTrain(const EncodingProfile& profile, Volts amplitude, std::optional<Ohms> impedance) {
    if (!impedance) {
        return fail(ErrorCode::NotArmed, "a current source is not given {:.4g} V before the impedance was measured",
                    amplitude.value());
    }
    const double ohm = impedance->value();
    if (!(ohm > 0) || !std::isfinite(ohm)) {
        return invalid("impedance {} ohm is not a finite number above 0", ohm);
    }
    PulseTrain train = profile.train;
    train.amplitude = Milliamps(amplitude.value() / ohm * 1e3);
    return train;
}

Result<PulseTrain> trainFor(Drive source, const EncodingProfile& profile, Volts amplitude,
                            std::optional<Ohms> impedance) {
    switch (source) {
        case Drive::Voltage:
            return voltageTrain(profile, amplitude);
        case Drive::Current:
            return currentTrain(profile, amplitude, impedance);
        case Drive::HighImpedance:
            break;
    }
    return invalid("a source with high impedance cannot deliver a train");
}

}  // namespace tacto
