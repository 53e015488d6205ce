#include "core/encoding/AmplitudeCalibration.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

template <class Change>
PulseTrain withAmplitude(PulseTrain train, Change change) noexcept {
    if (const auto* volts = std::get_if<Volts>(&train.amplitude)) {
        train.amplitude = Volts(change(volts->value()));
    } else {
        train.amplitude = Milliamps(change(std::get<Milliamps>(train.amplitude).value()));
    }
    return train;
}

}  // namespace

double AmplitudeCalibration::delivered(double told) const noexcept {
    if (told < lowest) return told * ratioAt(lowest);
    if (told > highest) return told * ratioAt(highest);
    return gain * told + offset;
}

double AmplitudeCalibration::told(double wanted) const noexcept {
    if (wanted < gain * lowest + offset) return wanted / ratioAt(lowest);
    if (wanted > gain * highest + offset) return wanted / ratioAt(highest);
    return (wanted - offset) / gain;
}

double AmplitudeCalibration::atMost(double told) const noexcept {
    const double line = told > 0 ? gain * told + offset : told;
    const double ratio = delivered(told);
    return std::max(line, ratio);
}

double AmplitudeCalibration::atLeast(double told) const noexcept {
    const double line = told > 0 ? std::max(gain * told + offset, 0.0) : told;
    return std::min(line, delivered(told));
}

Result<void> validateNumbers(const AmplitudeCalibration& c) {
    if (!(std::isfinite(c.gain) && c.gain > 0 && std::isfinite(c.offset))) {
        return fail(ErrorCode::InvalidArgument,
                    "the stimulator's calibration has the gain {} and the offset {}; finite numbers and a gain above 0 "
                    "are needed",
                    c.gain, c.offset);
    }
    if (!(c.lowest > 0 && c.highest > c.lowest && std::isfinite(c.highest))) {
        return fail(ErrorCode::InvalidArgument,
                    "the stimulator's calibration covers {} to {}; a range above 0 is needed", c.lowest, c.highest);
    }
    return {};
}

Result<void> validate(const AmplitudeCalibration& c) {
    if (auto sound = validateNumbers(c); !sound) return sound;
    for (const double told : {c.lowest, c.highest}) {
        const double off = c.delivered(told) / told - 1;
        if (!(std::abs(off) <= kLargestMiscalibration)) {
            return fail(ErrorCode::InvalidArgument,
                        "by its calibration the stimulator delivers {:.4g} when it is told {:.4g}, {:.3g} % off; at "
                        "most 20 % is accepted: it is out of order, or the calibration is not its own",
                        c.delivered(told), told, 100 * off);
        }
    }
    return {};
}

PulseTrain toldFor(PulseTrain train, const std::optional<AmplitudeCalibration>& calibration) noexcept {
    if (!calibration) return train;
    return withAmplitude(train, [&](double wanted) { return calibration->told(wanted); });
}

PulseTrain deliveredBy(PulseTrain train, const std::optional<AmplitudeCalibration>& calibration) noexcept {
    if (!calibration) return train;
    return withAmplitude(train, [&](double told) { return calibration->atMost(told); });
}

PulseTrain leastDeliveredBy(PulseTrain train, const std::optional<AmplitudeCalibration>& calibration) noexcept {
    if (!calibration) return train;
    return withAmplitude(train, [&](double told) { return calibration->atLeast(told); });
}

}  // namespace tacto
