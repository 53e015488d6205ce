#include "core/bench/delivery/DeliveryJudge.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {

/// IEC 60601-2-10 asks for an amplitude within 20 %. With a larger deviation, the limits were judged on another train
/// than the delivered one, or the device does not do what is programmed.
constexpr double kMaxDeviation = 0.20;

ElectrodeReading readingOf(ElectrodeState state) noexcept {
    switch (state) {
        case ElectrodeState::NotMeasured:
            return ElectrodeReading::NotMeasured;
        case ElectrodeState::Ok:
            return ElectrodeReading::Ok;
        case ElectrodeState::Open:
            return ElectrodeReading::Open;
        case ElectrodeState::Short:
            return ElectrodeReading::Short;
    }
    return ElectrodeReading::NotMeasured;
}

/// The deviation that a calibrated stimulator may have at its limit; the gate judges others by their deviation.
constexpr double kCommandTolerance = 0.05;

template <class... Values>
FixedText<255> faultText(fmt::format_string<const Values&...> text, const Values&... values) {
    return std::string_view(fmt::vformat(text, fmt::make_format_args(values...)));
}

std::optional<double> present(double value) noexcept { return std::isnan(value) ? std::nullopt : std::optional(value); }

}  // namespace

TrainReadBack readBackOf(const TrainReport& report) noexcept {
    return {.at = report.statusAt,
            .delivering = report.stillDelivering,
            .electrode = readingOf(report.electrode),
            .imbalance = present(report.imbalance),
            .imbalanceUncertainty = present(report.imbalanceUncertainty)};
}

std::optional<LoopFault> DeliveryJudge::delivered(const TrainReport& report, bool permitted) {
    const auto judgement = status(report);
    if (judgement.stops()) return LoopFault{causeOf(judgement.finding), judgement.reason.view()};
    if (auto fault = readBack(report); fault && !(fault->cause == FaultCause::DeviceFault && wasCutOff(report)))
        return fault;
    return permitted ? reading(report) : std::nullopt;
}

/// A source that reads back must read every train: delivery must not continue without knowing the electrode.
std::optional<LoopFault> DeliveryJudge::reading(const TrainReport& report) {
    const bool put = report.isCheck || expected_ > 0;  // without output there is nothing to read
    const bool unread = std::isnan(report.measured);
    if (put && unread && readsAmplitude_)
        return LoopFault{FaultCause::StatusMissing,
                         "the stimulator's answer has no reading of the amplitude of its train"};
    if (!source_.readsBack) return std::nullopt;
    if (!std::isnan(report.impedance_ohm)) return updateImpedance(Ohms(report.impedance_ohm), report.statusAt);
    if (report.isCheck) return LoopFault{FaultCause::StatusMissing, "the impedance check was not read back"};
    if (!put) return std::nullopt;
    const double check = source_.drive == Drive::Current ? source_.checkCurrent.value() : source_.checkVoltage.value();
    if (report.amplitude >= check)
        return LoopFault{FaultCause::StatusMissing,
                         "the stimulator's answer has no reading of the electrode of its train"};
    // The train was too small to be read: a check pulse comes before the next train.
    load_.impedanceAt = std::min(load_.impedanceAt, report.onset - Interlock::kImpedanceAge);
    return std::nullopt;
}

/// True if a stop cut the train off: a stop disarms before it switches off, and the status may then show the pulse
/// before. Too much output is judged anyway, and so is a train that ended during a pause.
bool DeliveryJudge::wasCutOff(const TrainReport& report) const noexcept {
    const auto state = interlock_.state();
    return state == InterlockState::Disarmed || state == InterlockState::Disconnected ||
           (state == InterlockState::Checking && !report.isCheck);
}

TrainJudgement DeliveryJudge::status(const TrainReport& report) const noexcept {
    return judgeTrain(mode_, readBackOf(report), report.end, report.statusAt);
}

/// The programmed value may be corrected, so compare with the command and allow one step of the device, but not for a
/// check pulse: it is so small that one step would hide any error.
std::optional<LoopFault> DeliveryJudge::readBack(const TrainReport& report) {
    if (std::isnan(report.measured)) return std::nullopt;  // the device does not read it back
    readsAmplitude_ = true;
    const double expected = report.isCheck ? report.amplitude : expected_;
    // Less than this share of the command is noise; then no step is allowed for.
    constexpr double kAbsent = 0.1;
    const bool absent = report.measured < kAbsent * expected;
    const double step = report.isCheck || absent ? 0 : source_.amplitudeStep;
    return amplitude({"the stimulator reads back", report.measured, expected, report.amplitude, step,
                      kUnknownSpread.relative * report.measured, report.onset, report.isCheck});
}

/// In a fault only a broken limit is news, and only once: no lesser fault may hide it.
std::optional<LoopFault> DeliveryJudge::amplitude(const SeenAmplitude& seen) {
    if (seen.onset < load_.armedAt) return std::nullopt;
    auto fault = deviation(seen);
    if (fault && interlock_.state() == InterlockState::Faulted &&
        (fault->cause != FaultCause::LimitBroken || interlock_.causePersists(FaultCause::LimitBroken)))
        return std::nullopt;
    return fault;
}

std::optional<LoopFault> DeliveryJudge::deviation(const SeenAmplitude& seen) {
    if (std::isnan(seen.expected)) return unasked(seen);
    const double off = seen.amplitude - seen.expected;
    const auto& stated = source_.accuracy.amplitude;
    const double uncertainty = seen.uncertainty + (stated ? stated->absolute : 0);
    if (std::abs(off) <= kMaxDeviation * seen.expected + uncertainty) return overLimit(seen);
    return LoopFault{off < 0 ? FaultCause::DeviceFault : FaultCause::LimitBroken,
                     faultText("{} {:.4g} {}; {:.4g} {} was commanded, and it must be within 20 % of that", seen.by,
                               seen.amplitude, unit(), seen.expected, unit())};
}

/// Output above the gate's assumption is a fault if it breaks a limit: the gate's worst case times the excess, or times
/// its square for a squared quantity. The commanded voltage is compared with its limit as measured.
std::optional<LoopFault> DeliveryJudge::overLimit(const SeenAmplitude& seen) {
    if (seen.isCheck) return std::nullopt;
    const auto judged = gate_.amplitudes(seen.programmed);
    const double uncertainty = seen.uncertainty + seen.unstated;
    const double proven = seen.amplitude - uncertainty;
    const double over = std::max(1.0, proven / judged.most);
    bool beyond = proven > std::min(judged.most, kUnknownSpread.above(seen.expected)) ||
                  seen.amplitude + uncertainty < std::max(judged.least, kUnknownSpread.below(seen.expected));
    const double stated = std::clamp(judged.most / seen.expected - 1, 0.0, kCommandTolerance);
    std::optional<LoopFault> fault;
    gate_.exposure(rows_);
    for (const auto& row : rows_) {
        if (row.action != LimitAction::Refuse || !row.evaluated || std::isnan(row.limit)) continue;
        const bool isCommand = row.quantity == Quantity::CommandVoltage;
        const bool squared = row.quantity == Quantity::PulseEnergy || row.quantity == Quantity::PowerDensity;
        const double value = isCommand ? voltsOf(proven) / (1 + stated) : row.value * (squared ? over * over : over);
        beyond = beyond || (isCommand && voltsOf(seen.amplitude) > row.limit * (1 + stated));
        if (fault || (!isCommand && over == 1) || std::isnan(value) || value <= row.limit) continue;
        fault = LoopFault{FaultCause::LimitBroken,
                          faultText("{} {:.4g} {} where {:.4g} {} was set: more than the limit of {} ({}), {:.4g} {}",
                                    seen.by, seen.amplitude, unit(), seen.expected, unit(), titleOf(row.quantity),
                                    row.set.view(), row.limit, row.unit)};
    }
    keep(seen, beyond || fault);
    return fault;
}

/// An output without a command is compared only with the limit on the commanded voltage, whatever its cause. While
/// disarmed, only one of the time before counts: what a free oscilloscope shows then is not the program's.
std::optional<LoopFault> DeliveryJudge::unasked(const SeenAmplitude& seen) {
    const auto state = interlock_.state();
    const bool off = state == InterlockState::Disarmed || state == InterlockState::Disconnected;
    if (off && seen.onset > load_.leftAt) return std::nullopt;
    const double value = voltsOf(seen.amplitude - seen.uncertainty) / (1 + kCommandTolerance);
    gate_.exposure(rows_);
    for (const auto& row : rows_) {
        if (row.quantity != Quantity::CommandVoltage || row.action != LimitAction::Refuse || !(value > row.limit))
            continue;
        return LoopFault{
            FaultCause::LimitBroken,
            faultText("{} {:.4g} {} beside what was set: more than the limit of {} ({}), {:.4g} {}", seen.by,
                      seen.amplitude, unit(), titleOf(row.quantity), row.set.view(), row.limit, row.unit)};
    }
    return std::nullopt;
}

void DeliveryJudge::keep(const SeenAmplitude& seen, bool beyond) noexcept {
    constexpr Instant kStays = std::chrono::seconds(5);  // as long as the windows of the limits
    const bool another = std::isnan(measured_.amplitude) || seen.onset - measured_.at > kStays;
    // A deviation stays visible.
    if (!another && (measured_.beyond != beyond ? measured_.beyond : measured_.amplitude > seen.amplitude)) return;
    measured_ = {
        seen.by, seen.onset, seen.amplitude, seen.uncertainty + seen.unstated, seen.expected, voltsOf(seen.amplitude),
        beyond};
}

double DeliveryJudge::voltsOf(double amplitude) const noexcept {
    if (source_.drive != Drive::Current) return amplitude;
    const auto& known = load_.impedance ? load_.impedance : load_.reference;
    return known ? amplitude * 1e-3 * known->value() : NAN;
}

std::optional<LoopFault> DeliveryJudge::load(const SeenLoad& seen, bool permitted, Instant now) {
    if (source_.readsBack || !permitted || seen.at < load_.armedAt) return std::nullopt;
    if (!seen.atLeast) return updateImpedance(seen.impedance, now);
    if (!(seen.impedance > load_.high)) return std::nullopt;  // then the current is too small to be seen in any case
    return LoopFault{
        FaultCause::OpenElectrode,
        faultText("the oscilloscope shows voltage and no current: the load is above {:.3g} ohm, open or not connected",
                  seen.impedance.value())};
}

std::optional<LoopFault> DeliveryJudge::silence(Instant trainEnd, bool goesOn, Instant now) const {
    std::optional<TrainReadBack> status;
    if (goesOn) {
        status.emplace();
        status->at = now;
        status->delivering = true;
    }
    const auto judgement = judgeTrain(mode_, status, trainEnd, now);
    if (!judgement.stops() || interlock_.state() == InterlockState::Faulted) return std::nullopt;
    return LoopFault{causeOf(judgement.finding), judgement.reason.view()};
}

std::optional<LoopFault> DeliveryJudge::updateImpedance(Ohms measured, Instant at) {
    if (const auto updated = gate_.updateImpedance(measured, at); !updated)
        return LoopFault{FaultCause::LimitBroken, std::string_view(updated.error().message)};
    load_.impedance = measured;
    load_.impedanceAt = at;
    return std::nullopt;
}

}  // namespace tacto
