#include "core/safety/DeliveryBounds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/safety/Rules.h"

namespace tacto {

namespace {

constexpr double kMinRatio = 0.01;  // the same as for CalibrationLine: with a lower ratio, a window would last forever

/// The spreads that extend the bounds beyond the programmed value.
struct Widening {
    const std::optional<CalibrationLine>& known;
    const std::optional<Spread>& stated;
    std::optional<CalibrationLine> line{};
    Spread ofLine{}, ofStated{};
};

constexpr gate::Duty<Widening> kWidenings[] = {
    {gate::MoreThanProgrammed, [](auto& w) noexcept { w.line = w.known; }},
    {gate::Uncertainty,
     [](auto& w) noexcept {
         w.ofStated = w.stated.value_or(kUnknownSpread);
         if (w.known) w.ofLine = w.known->spread.value_or(kUnknownSpread);
     }},
};

double siAmplitude(const PulseTrain& train) noexcept { return siValue(train.amplitude); }

struct Level {
    const PulseTrain& programmed;
    PulseTrain delivered;
};

/// The delivered level may be higher than the programmed one.
constexpr gate::Condition<Level> kLevelConditions[] = {
    {gate::LevelMoreThanProgrammed,
     [](auto& level) noexcept { return siAmplitude(level.delivered) > siAmplitude(level.programmed); }},
};

std::optional<CalibrationLine> lineIn(const KnownLines& known,
                                      std::optional<CalibrationLine> StimulatorCalibration::*line) noexcept {
    return known ? (*known).*line : std::nullopt;
}

}  // namespace

QuantityBounds::QuantityBounds(const std::optional<CalibrationLine>& line, bool applied,
                               const std::optional<Spread>& stated) noexcept
    : applied_(applied && line) {
    Widening widening{line, stated};
    gate::fulfil(kWidenings, widening);
    line_ = widening.line;
    ofLine_ = widening.ofLine;
    stated_ = widening.ofStated;
}

double QuantityBounds::most(double programmed) const noexcept {
    const double itself = applied_ ? programmed : stated_.above(programmed);
    return line_ ? std::max(itself, ofLine_.above(line_->atMost(programmed))) : itself;
}

double QuantityBounds::least(double programmed) const noexcept {
    const double itself = applied_ ? programmed : stated_.below(programmed);
    return line_ ? std::min(itself, ofLine_.below(line_->atLeast(programmed))) : itself;
}

double QuantityBounds::leastRatio(double programmed) const noexcept {
    double ratio = least(programmed) / programmed;
    if (line_) {
        for (const double at : {line_->lowest, line_->highest}) ratio = std::min(ratio, least(at) / at);
    }
    return std::clamp(ratio, kMinRatio, 1.0);
}

WorstOfRange::NetCharges WorstOfRange::netChargesOf(const TrainExposure& exposure) noexcept {
    return {exposure.at(Quantity::NetCharge), exposure.at(Quantity::DcCurrent), exposure.in1s.netCharge_C,
            exposure.in5s.netCharge_C};
}

void WorstOfRange::addCorner(const TrainExposure& corner) noexcept {
    worst_ = worse(worst_, corner);
    const auto charges = netChargesOf(corner);
    for (std::size_t k = 0; k < charges.size(); ++k) corners_[k] += charges[k];
    ++count_;
}

void WorstOfRange::addAxis(const TrainExposure& least, const TrainExposure& most) noexcept {
    worst_ = worse(worst_, worse(least, most));
    const auto low = netChargesOf(least), middle = netChargesOf(middle_), high = netChargesOf(most);
    for (std::size_t k = 0; k < middle.size(); ++k) {
        const double bend = middle[k] - 0.5 * (low[k] + high[k]);
        bends_[k] += bend;
        sizes_[k] += std::abs(bend);
    }
}

TrainExposure WorstOfRange::worst() const noexcept {
    const auto middle = netChargesOf(middle_);
    NetCharges more{};
    for (std::size_t k = 0; k < more.size(); ++k)
        more[k] = 2 * (sizes_[k] + std::abs(middle[k] - corners_[k] / count_ - bends_[k]));
    TrainExposure worst = worst_;
    worst.values[indexOf(Quantity::NetCharge)] += more[0];
    worst.values[indexOf(Quantity::DcCurrent)] += more[1];
    worst.in1s.netCharge_C += more[2];
    worst.in5s.netCharge_C += more[3];
    return worst;
}

DeliveryBounds::DeliveryBounds(const GateSetup& setup) noexcept
    : known_(setup.calibration),
      applied_(setup.calibrated && setup.calibration.has_value()),
      amplitude_(setup.calibration ? std::optional(setup.calibration->amplitude) : std::nullopt, applied_,
                 setup.source.accuracy.amplitude),
      width_(lineIn(setup.calibration, &StimulatorCalibration::phaseWidth), applied_, setup.source.accuracy.phaseWidth),
      gap_(lineIn(setup.calibration, &StimulatorCalibration::gap), applied_, setup.source.accuracy.gap),
      interval_(lineIn(setup.calibration, &StimulatorCalibration::interval), applied_, setup.source.accuracy.interval),
      rate_(std::nullopt, applied_, setup.source.accuracy.rate) {}

PulseTrain DeliveryBounds::commandOf(const PulseTrain& programmed) const noexcept {
    return applied_ ? deliveredBy(programmed, *known_) : programmed;
}

PulseTrain DeliveryBounds::levelOf(const PulseTrain& programmed) const noexcept {
    const Level level{programmed, mostDelivered(programmed, known_)};
    return gate::firstBroken(kLevelConditions, level) != nullptr ? level.delivered : programmed;
}

PulseTrain DeliveryBounds::acceptedAs(const PulseTrain& programmed) const noexcept {
    const PulseTrain delivered = leastDelivered(programmed, known_);
    return siAmplitude(delivered) < siAmplitude(programmed) ? delivered : programmed;
}

PulseTrain DeliveryBounds::densest(const PulseTrain& programmed) const noexcept {
    PulseTrain out = withAmplitude(programmed, [this](double amplitude) { return amplitude_.most(amplitude); });
    out.phaseWidth = width_.times(programmed.phaseWidth).most;
    out.interPhaseGap = gap_.times(programmed.interPhaseGap).most;
    out.rate = ratesOf(programmed.rate).most;
    return out;
}

PulseTrain DeliveryBounds::longest(const PulseTrain& programmed) const noexcept {
    PulseTrain out = densest(programmed);
    out.rate = ratesOf(programmed.rate).least;
    return out;
}

}  // namespace tacto
