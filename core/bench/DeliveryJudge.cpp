#include "core/bench/DeliveryJudge.h"

#include <cmath>

namespace tacto {

namespace {

/// IEC 60601-2-10 asks for an amplitude within 20 %; more than that beside the command, and the limits were judged on
/// a train that is not the one delivered, or the device does not do what is programmed.
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
    if (!source_.readsBack || !permitted) return std::nullopt;
    if (!std::isnan(report.impedance_ohm)) return updateImpedance(Ohms(report.impedance_ohm), report.statusAt);
    // A train too small to be read leaves the last reading to grow old; a check exists to be read.
    if (!report.isCheck) return std::nullopt;
    return LoopFault{FaultCause::StatusMissing, "the impedance check was not read back"};
}

/// A stop disarms before it switches off: what was being delivered may then read as the pulse before it. Whether too
/// much came out is judged all the same, and so is a train that a pause let end.
bool DeliveryJudge::wasCutOff(const TrainReport& report) const noexcept {
    const auto state = interlock_.state();
    return state == InterlockState::Disarmed || state == InterlockState::Disconnected ||
           (state == InterlockState::Checking && !report.isCheck);
}

TrainJudgement DeliveryJudge::status(const TrainReport& report) const noexcept {
    return judgeTrain(mode_, readBackOf(report), report.end, report.statusAt);
}

/// What is programmed proves nothing: a calibration may have made it so. The command must come out, read back in the
/// device's own steps; a check pulse is so small that a step would excuse anything.
std::optional<LoopFault> DeliveryJudge::readBack(const TrainReport& report) const {
    if (std::isnan(report.measured)) return std::nullopt;  // it is not read back
    const double expected = report.isCheck ? report.amplitude : expected_;
    const double step = report.isCheck ? 0 : source_.amplitudeStep;
    return amplitude({"the stimulator reads back", report.measured, expected, step, report.onset});
}

std::optional<LoopFault> DeliveryJudge::amplitude(const SeenAmplitude& seen) const {
    const double off = seen.amplitude - seen.expected;
    const auto& stated = source_.accuracy.amplitude;
    const double uncertainty = seen.uncertainty + (stated ? stated->absolute : 0);
    if (std::abs(off) <= kMaxDeviation * seen.expected + uncertainty) return std::nullopt;
    if (seen.onset < load_.armedAt || interlock_.state() == InterlockState::Faulted) return std::nullopt;
    const auto* unit = amplitudeUnit(source_.drive);
    return LoopFault{off < 0 ? FaultCause::DeviceFault : FaultCause::LimitBroken,
                     faultText("{} {:.4g} {}; {:.4g} {} was commanded, and it must be within 20 % of that", seen.by,
                               seen.amplitude, unit, seen.expected, unit)};
}

std::optional<LoopFault> DeliveryJudge::load(const SeenLoad& seen, bool permitted, Instant now) {
    if (source_.readsBack || !permitted || seen.at < load_.armedAt) return std::nullopt;
    if (!seen.atLeast) return updateImpedance(seen.impedance, now);
    if (!(seen.impedance > load_.high)) return std::nullopt;  // too little current to be seen anyway
    return LoopFault{
        FaultCause::OpenElectrode,
        faultText("the oscilloscope shows voltage and no current: the load is above {:.3g} ohm, open or not connected",
                  seen.impedance.value())};
}

std::optional<LoopFault> DeliveryJudge::silence(Instant trainEnd, Instant now) const {
    const auto judgement = judgeTrain(mode_, std::nullopt, trainEnd, now);
    if (!judgement.stops() || interlock_.state() == InterlockState::Faulted) return std::nullopt;
    return LoopFault{FaultCause::StatusMissing, judgement.reason.view()};
}

std::optional<LoopFault> DeliveryJudge::updateImpedance(Ohms measured, Instant at) {
    if (const auto updated = gate_.updateImpedance(measured, at); !updated)
        return LoopFault{FaultCause::LimitBroken, std::string_view(updated.error().message)};
    load_.impedance = measured;
    load_.impedanceAt = at;
    return std::nullopt;
}

}  // namespace tacto
