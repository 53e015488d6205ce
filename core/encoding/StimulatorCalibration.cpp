#include "core/encoding/StimulatorCalibration.h"

#include <algorithm>

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

}  // namespace tacto
