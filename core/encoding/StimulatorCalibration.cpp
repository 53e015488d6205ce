#include "core/encoding/StimulatorCalibration.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

Seconds programmed(Seconds wanted, const std::optional<CalibrationLine>& line) noexcept {
    return line ? Seconds(line->programmedFor(wanted.count())) : wanted;
}

template <class Check>
Result<void> ofEachLine(const StimulatorCalibration& c, Check check) {
    if (auto sound = check(c.amplitude, kCalibratedAmplitude.words); !sound) return sound;
    for (const auto& time : kTimeLines<StimulatorCalibration>) {
        if (!(c.*time.line)) continue;
        if (auto sound = check(*(c.*time.line), time.words); !sound) return sound;
    }
    return {};
}

}  // namespace

Result<void> validateNumbers(const StimulatorCalibration& calibration) {
    return ofEachLine(calibration, [](const auto& line, auto quantity) { return validateNumbers(line, quantity); });
}

Result<void> validate(const StimulatorCalibration& calibration) {
    return ofEachLine(calibration, [](const auto& line, auto quantity) { return validate(line, quantity); });
}

PulseTrain programmedFor(PulseTrain train, const KnownLines& calibration) noexcept {
    if (!calibration) return train;
    if (calibration->phaseWidth) train.phaseWidth = programmed(train.phaseWidth, calibration->phaseWidth);
    if (calibration->gap) train.interPhaseGap = programmed(train.interPhaseGap, calibration->gap);
    return withAmplitude(train, [&](double wanted) { return calibration->amplitude.programmedFor(wanted); });
}

Seconds programmedFor(Seconds interval, const KnownLines& calibration) noexcept {
    return calibration ? programmed(interval, calibration->interval) : interval;
}

PulseTrain deliveredBy(PulseTrain train, const StimulatorCalibration& c) noexcept {
    if (c.phaseWidth) train.phaseWidth = Seconds(c.phaseWidth->atMost(Seconds(train.phaseWidth).count()));
    if (c.gap) train.interPhaseGap = Seconds(c.gap->atMost(Seconds(train.interPhaseGap).count()));
    return withAmplitude(train, [&](double programmed) { return c.amplitude.atMost(programmed); });
}

PulseTrain mostDelivered(PulseTrain train, const KnownLines& calibration) noexcept {
    if (!calibration) return train;
    return withAmplitude(train, [&](double programmed) { return calibration->amplitude.atMost(programmed); });
}

PulseTrain leastDelivered(PulseTrain train, const KnownLines& calibration) noexcept {
    if (!calibration) return train;
    return withAmplitude(train, [&](double programmed) { return calibration->amplitude.atLeast(programmed); });
}

namespace {

constexpr double kSmallestShare = 0.01;  // a smaller share would shrink times to nothing and make windows endless

}  // namespace

double CalibrationLine::delivered(double programmed) const noexcept {
    if (programmed < lowest) return programmed * ratioAt(lowest);
    if (programmed > highest) return programmed * ratioAt(highest);
    return gain * programmed + offset;
}

double CalibrationLine::programmedFor(double wanted) const noexcept {
    if (wanted < gain * lowest + offset) return wanted / ratioAt(lowest);
    if (wanted > gain * highest + offset) return wanted / ratioAt(highest);
    return (wanted - offset) / gain;
}

double CalibrationLine::atMost(double programmed) const noexcept {
    const double line = programmed > 0 ? gain * programmed + offset : programmed;
    const double ratio = delivered(programmed);
    return std::max(line, ratio);
}

double CalibrationLine::atLeast(double programmed) const noexcept {
    const double line = programmed > 0 ? std::max(gain * programmed + offset, 0.0) : programmed;
    return std::min(line, delivered(programmed));
}

Result<void> validateNumbers(const CalibrationLine& line, std::string_view quantity) {
    if (!(std::isfinite(line.gain) && line.gain > 0 && std::isfinite(line.offset))) {
        return invalid(
            "the stimulator's calibration of {} has the gain {} and the offset {}; finite numbers and a gain "
            "above 0 are needed",
            quantity, line.gain, line.offset);
    }
    if (!(line.lowest > 0 && line.highest > line.lowest && std::isfinite(line.highest))) {
        return invalid("the stimulator's calibration of {} covers {} to {}; a range above 0 is needed", quantity,
                       quantity, line.lowest, line.highest);
    }
    const Spread spread = line.spread.value_or(kUnknownSpread);
    if (!spread.sound()) {
        return invalid(
            "the stimulator's calibration of {} has an uncertainty of {} % and {}; 0 or more and less than 100 "
            "% are needed",
            quantity, 100 * spread.relative, spread.absolute);
    }
    for (const double programmed : {line.lowest, line.highest}) {
        if (!(spread.below(line.delivered(programmed)) >= kSmallestShare * programmed)) {
            return invalid(
                "by its calibration of {} the stimulator may deliver {:.4g} when it is programmed to {:.4g}; "
                "at least a "
                "hundredth of it is needed",
                quantity, spread.below(line.delivered(programmed)), programmed);
        }
    }
    return {};
}

Result<void> validate(const CalibrationLine& line, std::string_view quantity) {
    if (auto sound = validateNumbers(line, quantity); !sound) return sound;
    for (const double programmed : {line.lowest, line.highest}) {
        const double off = line.delivered(programmed) / programmed - 1;
        if (!(std::abs(off) <= kLargestMiscalibration)) {
            return invalid(
                "by its calibration of {} the stimulator delivers {:.4g} when it is programmed to {:.4g}, "
                "{:.3g} % off; "
                "at most 20 % is accepted: it is out of order, or the calibration is not its own",
                quantity, line.delivered(programmed), programmed, 100 * off);
        }
    }
    return {};
}

}  // namespace tacto
