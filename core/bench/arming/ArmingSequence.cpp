#include "core/bench/arming/ArmingSequence.h"

#include <cmath>
#include <utility>

namespace tacto {

void ArmingSequence::expect() {
    const std::scoped_lock lock(resultMutex_);
    result_.reset();
}

std::optional<Result<void>> ArmingSequence::result() {
    const std::scoped_lock lock(resultMutex_);
    return std::exchange(result_, std::nullopt);
}

void ArmingSequence::begin(ArmCommand command) noexcept {
    command_ = std::move(command);
    checkPosted_ = checkRead_ = false;
    confirmed_.reset();
    load_.impedance.reset();
}

std::optional<ApprovedTrain> ArmingSequence::checkPulse(Instant now, bool hasStimulator) noexcept {
    checkPosted_ = true;
    if (const auto configured = gate_.configure(command_->setup); !configured) {
        refuse("arming was refused", configured.error());
        return std::nullopt;
    }
    const bool looksAtCapture = command_->confirmByCapture && command_->evidence.declaredLoadConfirmed;
    if (!hasStimulator || !(command_->evidence.readsBack || looksAtCapture)) {
        armWithoutCheck(now);
        return std::nullopt;
    }
    auto check = gate_.approveCheck(now);
    if (!check) {
        refuse("the impedance check was refused", check.error());
        return std::nullopt;
    }
    return std::move(*check);
}

/// Arms on the operator's word alone; also arms a massager, because nothing measures its load.
void ArmingSequence::armWithoutCheck(Instant now) noexcept {
    command_->evidence.impedanceAt = now;
    const auto permitted = interlock_.arm(command_->evidence, now);
    if (!permitted) interlock_.disarm("arming was refused");
    load_.reference = command_->declared;
    load_.high = command_->evidence.impedanceHigh;
    load_.armedAt = now;
    finish(permitted);
}

void ArmingSequence::checkRead(const TrainReport& report) noexcept {
    if (command_->confirmByCapture) {
        checkRead_ = true;  // armOnCapture() does the rest
        return;
    }
    auto evidence = command_->evidence;
    if (std::isfinite(report.impedance_ohm)) evidence.impedance = Ohms(report.impedance_ohm);
    armOnImpedance(evidence, report.statusAt);
}

void ArmingSequence::confirm(Result<Ohms> seen) noexcept {
    if (command_) confirmed_ = std::move(seen);
}

void ArmingSequence::armOnCapture(Instant now) noexcept {
    if (!command_ || !checkRead_ || !confirmed_) return;
    const auto seen = *std::exchange(confirmed_, std::nullopt);
    if (!seen) {
        return refuse("the oscilloscope did not confirm the check pulse",
                      {ErrorCode::NotArmed, fmt::format("not armed: {}", seen.error().message)});
    }
    auto evidence = command_->evidence;
    evidence.impedance = *seen;
    load_.high = evidence.impedanceHigh;
    load_.armedAt = now;
    armOnImpedance(evidence, now);
}

void ArmingSequence::armOnImpedance(ArmingEvidence evidence, Instant at) noexcept {
    evidence.impedanceAt = at;
    if (evidence.impedance) {
        if (const auto updated = gate_.updateImpedance(*evidence.impedance, at); !updated)
            return refuse("the measured impedance is outside its range", updated.error());
    }
    if (const auto permitted = interlock_.arm(evidence, at); !permitted)
        return refuse("the impedance check did not pass", permitted.error());
    load_.impedance = load_.reference = evidence.impedance;
    load_.impedanceAt = load_.armedAt = at;
    finish({});
}

void ArmingSequence::refuse(const char* reason, Error error) noexcept {
    interlock_.disarm(reason);
    finish(tl::unexpected<Error>(std::move(error)));
}

void ArmingSequence::stop() noexcept {
    // The stop may have come before the interlock entered Checking; so the arming is refused here, too.
    refuse("stopped", {ErrorCode::Stopped, "arming ended: stopped. Output is off."});
}

void ArmingSequence::finish(Result<void> result) noexcept {
    command_.reset();
    const std::scoped_lock lock(resultMutex_);
    result_ = std::move(result);
}

}  // namespace tacto
