// What the devices report of each train, and what becomes of it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bench/ControlLoop.h"
#include "core/safety/TrainCheck.h"

namespace tacto {

namespace {

/// IEC 60601-2-10 asks for an amplitude within 20 %; more than that beside the command, and the limits were judged on
/// a train that is not the one delivered, or the device does not do what it is told.
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

/// In words, of literals: the loop does not allocate.
std::string_view shapeText(const PulseTrain& train) noexcept {
    const bool positive = train.polarity == Polarity::Positive;
    switch (train.shape) {
        case PulseShape::SymmetricBiphasic:
            return positive ? "symmetric biphasic, positive phase first" : "symmetric biphasic, negative phase first";
        case PulseShape::AsymmetricBiphasic:
            return positive ? "asymmetric biphasic, positive phase first" : "asymmetric biphasic, negative phase first";
        case PulseShape::Monophasic:
            return positive ? "monophasic, positive" : "monophasic, negative";
    }
    return {};
}

std::optional<double> present(double value) noexcept { return std::isnan(value) ? std::nullopt : std::optional(value); }

TrainReadBack readBackOf(const TrainReport& report) noexcept {
    return {.at = report.statusAt,
            .delivering = report.stillDelivering,
            .electrode = readingOf(report.electrode),
            .imbalance = present(report.imbalance),
            .imbalanceUncertainty = present(report.imbalanceUncertainty)};
}

}  // namespace

void ControlLoop::judgeReports() noexcept {
    if (parts_.stimulator != nullptr) {
        while (const auto report = parts_.stimulator->takeReport()) judge(*report);
    } else if (parts_.massager != nullptr) {
        while (const auto report = parts_.massager->takeReport()) judgeBurst(*report);
    }
}

/// One row for each train: what the stimulator was told, by which approval, and what it read back.
void ControlLoop::recordTrain(const TrainReport& report, const char* name) noexcept {
    if (parts_.recorder == nullptr) return;
    const auto& train = report.train;
    parts_.recorder->command(
        report.onset, name,
        {{"is_check", report.isCheck ? 1.0 : 0.0},
         {isCurrent(train.amplitude) ? "amplitude_ma" : "amplitude_v", report.amplitude},
         {"measured", report.measured},
         {"pulses", static_cast<double>(train.pulses)},
         {"rate_hz", train.rate.value()},
         {"width_s", Seconds(train.phaseWidth).count()},
         {"gap_s", Seconds(train.interPhaseGap).count()},
         {"recharge_ratio", train.shape == PulseShape::AsymmetricBiphasic ? train.rechargeRatio : NAN},
         {"interval_s", report.interval_s},
         {"approved_until_s", toSeconds(report.approvedUntil)},
         {"impedance_ohm", report.impedance_ohm},
         {"imbalance", report.imbalance}},
        report.error.empty() ? shapeText(train) : report.error.view());
}

void ControlLoop::recordBurst(const TrainReport& report, const char* name) noexcept {
    if (parts_.recorder == nullptr) return;
    parts_.recorder->command(report.onset, name,
                             {{"intensity", report.amplitude},
                              {"duration_s", toSeconds(std::max(Instant(0), report.end - report.onset))},
                              {"interval_s", report.interval_s}},
                             report.error.view());
}

void ControlLoop::judge(const TrainReport& report) noexcept {
    const Instant now = report.statusAt;
    if (parts_.tap != nullptr) parts_.tap->trains.push(report);
    if (report.outcome == TrainOutcome::LoopSilent) {
        if (mayPost(false)) trip(FaultCause::LoopSilent, report.error.view(), now);
        return;
    }
    if (report.outcome == TrainOutcome::Voided) {
        recordTrain(report, "voided");
        if (arming_ && report.isCheck) {
            parts_.interlock.disarm("the impedance check was voided");
            finishArming(fail(ErrorCode::Stopped, "arming ended: the impedance check was voided by a stop"));
        }
        return;
    }
    recordTrain(report, report.outcome == TrainOutcome::Failed ? "failed"
                        : report.isCheck                       ? "impedance check"
                                                               : "delivered");
    if (report.outcome == TrainOutcome::Failed) return trip(FaultCause::DeviceFault, report.error.view(), now);
    if (report.isCheck && arming_) return judgeCheck(report);

    if (!report.isCheck) {
        ++shown_.trainsDelivered;
        shown_.trainAmplitude = report.amplitude;
    }
    shown_.imbalance = report.imbalance;
    shown_.imbalanceUncertainty = report.imbalanceUncertainty;
    const auto judgement = judgeTrain(parts_.mode, readBackOf(report), report.end, now);
    if (judgement.stops()) return trip(causeOf(judgement.finding), judgement.reason.view(), now);
    if (judgeReadBack(report)) return;
    if (parts_.stimulator->device().traits().readsBack && mayPost(report.isCheck)) judgeImpedance(report);
}

/// What was told proves nothing: a calibration may have made it so. The command must come out, read back in the
/// device's own steps; a check pulse is so small that a step would excuse anything.
bool ControlLoop::judgeReadBack(const TrainReport& report) noexcept {
    if (std::isnan(report.measured)) return false;  // it is not read back
    const double expected = report.isCheck ? report.amplitude : expected_;
    const double step = report.isCheck ? 0 : parts_.stimulator->device().traits().amplitudeStep;
    return judgeAmplitude({"the stimulator reads back", report.measured, expected, step, report.onset},
                          report.statusAt);
}

bool ControlLoop::judgeAmplitude(const SeenAmplitude& seen, Instant now) noexcept {
    const double off = seen.amplitude - seen.expected;
    const auto& stated = parts_.stimulator->device().traits().accuracy.amplitude;
    const double uncertainty = seen.uncertainty + (stated ? stated->absolute : 0);
    if (std::abs(off) <= kMaxDeviation * seen.expected + uncertainty) return false;
    if (seen.onset < armedAt_ || parts_.interlock.state() == InterlockState::Faulted) return false;
    const auto* unit = parts_.stimulator->device().traits().drive == Drive::Current ? "mA" : "V";
    trip(off < 0 ? FaultCause::DeviceFault : FaultCause::LimitBroken,
         fmt::format("{} {:.4g} {} where {:.4g} {} was commanded; at most 20 % beside it is accepted", seen.by,
                     seen.amplitude, unit, seen.expected, unit),
         now);
    return true;
}

void ControlLoop::judgeBurst(const TrainReport& report) noexcept {
    const Instant now = report.statusAt;
    if (parts_.tap != nullptr) parts_.tap->trains.push(report);
    if (report.outcome == TrainOutcome::LoopSilent) {
        if (mayPost(false)) trip(FaultCause::LoopSilent, report.error.view(), now);
        return;
    }
    const bool delivered = report.outcome == TrainOutcome::Delivered;
    recordBurst(report, delivered ? "delivered" : report.outcome == TrainOutcome::Failed ? "failed" : "voided");
    if (report.outcome == TrainOutcome::Failed) return trip(FaultCause::DeviceFault, report.error.view(), now);
    if (!delivered) return;
    ++shown_.trainsDelivered;
    shown_.intensity = report.amplitude;
}

void ControlLoop::judgeImpedance(const TrainReport& report) noexcept {
    const Instant now = report.statusAt;
    if (std::isnan(report.impedance_ohm)) {
        // A train too small to be read leaves the last reading to grow old; a check exists to be read.
        if (report.isCheck) trip(FaultCause::StatusMissing, "the impedance check was not read back", now);
        return;
    }
    updateImpedance(Ohms(report.impedance_ohm), now);
}

void ControlLoop::updateImpedance(Ohms measured, Instant at) noexcept {
    if (const auto updated = parts_.gate.updateImpedance(measured, at); !updated) {
        return trip(FaultCause::LimitBroken, updated.error().message, at);
    }
    impedance_ = measured;
    impedanceAt_ = at;
}

void ControlLoop::judgeLoad(const SeenLoad& seen, Instant now) noexcept {
    if (parts_.stimulator == nullptr || parts_.stimulator->device().traits().readsBack) return;
    if (!mayPost(false) || seen.at < armedAt_) return;
    if (!seen.atLeast) return updateImpedance(seen.impedance, now);
    if (!(seen.impedance > impedanceHigh_)) return;  // too little current to be seen anyway
    trip(FaultCause::OpenElectrode,
         fmt::format(
             "the oscilloscope shows voltage and no current: the load is above {:.3g} ohm, open or not connected",
             seen.impedance.value()),
         now);
}

void ControlLoop::judgeCheck(const TrainReport& report) noexcept {
    const auto judgement = judgeTrain(parts_.mode, readBackOf(report), report.end, report.statusAt);
    auto evidence = arming_->evidence;
    if (judgement.stops()) {
        parts_.interlock.disarm(judgement.reason.c_str());
        return finishArming(fail(ErrorCode::NotArmed, "not armed: {}", judgement.reason.view()));
    }
    // A fault of before may have been reset, and its cause still be there: nothing is armed on it.
    if (judgeReadBack(report)) return;
    if (arming_->confirmByCapture) {
        checkRead_ = true;  // the rest is for armOnCapture()
        return;
    }
    if (std::isfinite(report.impedance_ohm)) evidence.impedance = Ohms(report.impedance_ohm);
    armOnImpedance(evidence, report.statusAt);
}

void ControlLoop::armOnCapture(Instant now) noexcept {
    const auto seen = *std::exchange(confirmed_, std::nullopt);
    if (!seen) {
        parts_.interlock.disarm("the oscilloscope did not confirm the check pulse");
        return finishArming(fail(ErrorCode::NotArmed, "not armed: {}", seen.error().message));
    }
    auto evidence = arming_->evidence;
    evidence.impedance = *seen;
    impedanceHigh_ = evidence.impedanceHigh;
    armedAt_ = now;
    armOnImpedance(evidence, now);
}

void ControlLoop::armOnImpedance(const ArmingEvidence& given, Instant at) noexcept {
    auto evidence = given;
    evidence.impedanceAt = at;
    if (evidence.impedance) {
        if (const auto updated = parts_.gate.updateImpedance(*evidence.impedance, at); !updated) {
            parts_.interlock.disarm("the measured impedance is outside its range");
            return finishArming(updated);
        }
    }
    const auto permitted = parts_.interlock.arm(evidence, at);
    if (!permitted) {
        parts_.interlock.disarm("the impedance check did not pass");
        return finishArming(permitted);
    }
    impedance_ = evidence.impedance;
    armedAt_ = at;
    planner_->armedOn(impedance_);
    impedanceAt_ = at;
    finishArming({});
}

void ControlLoop::watchForSilence(Instant now) noexcept {
    if (parts_.stimulator == nullptr || parts_.stimulator->idle()) return;
    const auto judgement = judgeTrain(parts_.mode, std::nullopt, parts_.stimulator->trainEnd(), now);
    if (judgement.stops() && parts_.interlock.state() != InterlockState::Faulted) {
        trip(FaultCause::StatusMissing, judgement.reason.view(), now);
    }
}

}  // namespace tacto
