#include "core/safety/DeliveryBounds.h"

#include <algorithm>

#include "core/safety/GateChecks.h"

namespace tacto {

using gate::checks;

namespace {

constexpr double kLeastRatio = 0.01;  // as CalibrationLine: with less, a window would last for ever

double siAmplitude(const PulseTrain& train) noexcept { return siValue(train.amplitude); }

std::optional<CalibrationLine> lineIn(const KnownLines& known,
                                      std::optional<CalibrationLine> StimulatorCalibration::*line) noexcept {
    return known ? (*known).*line : std::nullopt;
}

}  // namespace

QuantityBounds::QuantityBounds(const std::optional<CalibrationLine>& line, bool applied,
                               const std::optional<Spread>& stated) noexcept
    : line_(line), stated_(stated.value_or(kUnknownSpread)), applied_(applied && line) {
    if (line_) ofLine_ = line_->spread.value_or(kUnknownSpread);
    if (!checks(gate::Uncertainty)) ofLine_ = stated_ = Spread{};
    if (!checks(gate::MoreThanTold)) line_.reset();
}

double QuantityBounds::most(double told) const noexcept {
    const double itself = applied_ ? told : stated_.above(told);
    return line_ ? std::max(itself, ofLine_.above(line_->atMost(told))) : itself;
}

double QuantityBounds::least(double told) const noexcept {
    const double itself = applied_ ? told : stated_.below(told);
    return line_ ? std::min(itself, ofLine_.below(line_->atLeast(told))) : itself;
}

double QuantityBounds::leastRatio(double told) const noexcept {
    double ratio = least(told) / told;
    if (line_) {
        for (const double at : {line_->lowest, line_->highest}) ratio = std::min(ratio, least(at) / at);
    }
    return std::clamp(ratio, kLeastRatio, 1.0);
}

DeliveryBounds::DeliveryBounds(const GateSetup& setup) noexcept
    : known_(setup.calibration),
      applied_(setup.calibrated && setup.calibration.has_value()),
      amplitude_(setup.calibration ? std::optional(setup.calibration->amplitude) : std::nullopt, applied_,
                 setup.source.accuracy.amplitude),
      width_(lineIn(setup.calibration, &StimulatorCalibration::phaseWidth), applied_, setup.source.accuracy.phaseWidth),
      gap_(lineIn(setup.calibration, &StimulatorCalibration::gap), applied_, setup.source.accuracy.gap),
      interval_(lineIn(setup.calibration, &StimulatorCalibration::interval), applied_, setup.source.accuracy.interval) {
}

PulseTrain DeliveryBounds::commandOf(const PulseTrain& told) const noexcept {
    return applied_ ? deliveredBy(told, *known_) : told;
}

PulseTrain DeliveryBounds::levelOf(const PulseTrain& told) const noexcept {
    const PulseTrain delivered = mostDelivered(told, known_);
    return siAmplitude(delivered) > siAmplitude(told) && checks(gate::MoreThanTold) ? delivered : told;
}

PulseTrain DeliveryBounds::acceptedAs(const PulseTrain& told) const noexcept {
    const PulseTrain delivered = leastDelivered(told, known_);
    return siAmplitude(delivered) < siAmplitude(told) ? delivered : told;
}

PulseTrain DeliveryBounds::largest(const PulseTrain& told) const noexcept {
    PulseTrain out = withAmplitude(told, [this](double amplitude) { return amplitude_.most(amplitude); });
    out.phaseWidth = width_.times(told.phaseWidth).most;
    out.interPhaseGap = gap_.times(told.interPhaseGap).most;
    return out;
}

}  // namespace tacto
