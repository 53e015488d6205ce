#include "core/safety/Interlock.h"

#include <algorithm>
#include <array>

#include "core/safety/GateChecks.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

using namespace gate;

namespace {
constexpr std::array<std::string_view, 7> kStates{"disconnected", "disarmed", "checking", "armed",
                                                  "delivering",   "paused",   "faulted"};
constexpr std::array<std::string_view, kFaultCauseCount> kCauses{
    "device lost",    "device fault", "open electrode", "shorted electrode", "net charge",
    "status missing", "loop silent",  "stale sensor",   "limit broken",      "internal error"};

constexpr std::uint32_t bitOf(FaultCause cause) noexcept { return 1U << static_cast<unsigned>(cause); }
}  // namespace

std::string_view nameOf(InterlockState state) noexcept { return kStates[static_cast<std::size_t>(state)]; }
std::string_view nameOf(FaultCause cause) noexcept { return kCauses[static_cast<std::size_t>(cause)]; }

FixedText<159> Interlock::reason() const noexcept {
    const std::lock_guard lock(mutex_);
    return reason_;
}

Result<void> Interlock::move(InterlockState from, InterlockState to, const char* what) {
    const std::lock_guard lock(mutex_);
    const InterlockState now = state_.load(std::memory_order_relaxed);
    if (checks(InterlockMove) && now != from) {
        return fail(ErrorCode::NotArmed, "cannot {} while {}; the interlock must be {}", what, nameOf(now),
                    nameOf(from));
    }
    state_.store(to, std::memory_order_release);
    if (to != InterlockState::Disarmed) reason_ = {};
    return {};
}

void Interlock::keepFaultsIn(UnitRecord& record) noexcept {
    const std::lock_guard lock(mutex_);
    record_ = &record;
    const auto left = record.fault();
    if (!left) return;
    // An error inside the program that had it is over with that program; the device is still to be looked at.
    const bool internal = (left->causes & bitOf(FaultCause::Internal)) != 0;
    causes_ |= (left->causes & ~bitOf(FaultCause::Internal)) | (internal ? bitOf(FaultCause::DeviceFault) : 0U);
    state_.store(InterlockState::Faulted, std::memory_order_release);
    std::array<char, 160> text{};
    const auto end = fmt::format_to_n(text.data(), text.size() - 1, "left by an earlier run: {}", left->reason.view());
    reason_ = std::string_view(text.data(), std::min(end.size, text.size() - 1));
}

Result<void> Interlock::connect(std::string_view note) {
    const auto connected = move(InterlockState::Disconnected, InterlockState::Disarmed, "connect");
    const std::lock_guard lock(mutex_);
    if (connected) reason_ = FixedText<159>(note);
    return connected;
}
Result<void> Interlock::disconnect() {
    return move(InterlockState::Disarmed, InterlockState::Disconnected, "disconnect");
}

Result<std::uint64_t> Interlock::requestArming(Instant now) {
    const std::lock_guard lock(mutex_);
    const InterlockState current = state_.load(std::memory_order_relaxed);
    if (checks(ArmRequestState) && current != InterlockState::Disarmed) {
        return fail(ErrorCode::NotArmed, "cannot start arming while {}; the interlock must be disarmed",
                    nameOf(current));
    }
    ticket_ = ++lastTicket_;
    requestedAt_ = now;
    return ticket_;
}

Result<void> Interlock::confirmArming(std::uint64_t ticket, Instant now) {
    const std::lock_guard lock(mutex_);
    const InterlockState current = state_.load(std::memory_order_relaxed);
    if (checks(ArmConfirmState) && current != InterlockState::Disarmed) {
        return fail(ErrorCode::NotArmed, "cannot confirm arming while {}; the interlock must be disarmed",
                    nameOf(current));
    }
    const bool valid = ticket != 0 && ticket == ticket_ && now >= requestedAt_ && now - requestedAt_ <= kConfirmWithin;
    ticket_ = 0;  // One request, one confirmation
    if (checks(ArmTicket) && !valid)
        return fail(ErrorCode::NotArmed, "arming was not requested within the last 30 s, or was stopped since");
    state_.store(InterlockState::Checking, std::memory_order_release);
    reason_ = {};
    return {};
}

Result<void> Interlock::arm(const ArmingEvidence& evidence, Instant now) {
    const std::lock_guard lock(mutex_);
    const InterlockState current = state_.load(std::memory_order_relaxed);
    if (checks(ArmState) && current != InterlockState::Checking) {
        return fail(ErrorCode::NotArmed, "cannot arm while {}; the interlock must be checking", nameOf(current));
    }
    if (checks(ArmLimits) && !evidence.limitsLoaded)
        return fail(ErrorCode::NotArmed, "cannot arm: no limit set is loaded");
    if (checks(ArmIdentity) && !evidence.deviceIdentified)
        return fail(ErrorCode::NotArmed, "cannot arm: the device is not identified");
    if (checks(ArmOperator) && !evidence.operatorConfirmed)
        return fail(ErrorCode::NotArmed, "cannot arm: the operator has not confirmed it");
    if (evidence.needsImpedance) {
        const bool declared = !evidence.readsBack && evidence.declaredLoadConfirmed;
        if (checks(ArmImpedanceMissing) && !evidence.impedance && !declared) {
            return fail(ErrorCode::NotArmed, "cannot arm: {}",
                        evidence.readsBack
                            ? "no impedance was measured"
                            : "the device reads no impedance back and the declared load is not confirmed");
        }
        if (evidence.impedance) {
            const double ohm = evidence.impedance->value();
            const double low = evidence.impedanceLow.value();
            const double high = evidence.impedanceHigh.value();
            if (checks(ArmImpedanceRange) && !(ohm >= low && ohm <= high)) {
                return fail(ErrorCode::NotArmed,
                            "cannot arm: the measured impedance is {:.4g} ohm; {:.4g} to {:.4g} ohm is accepted", ohm,
                            low, high);
            }
            const bool fresh = evidence.impedanceAt <= now && now - evidence.impedanceAt <= kImpedanceAge;
            if (checks(ArmImpedanceAge) && !fresh) {
                return fail(ErrorCode::NotArmed,
                            "cannot arm: the impedance was measured {:.3g} s ago; at most 5 s is accepted",
                            toSeconds(now - evidence.impedanceAt));
            }
        }
    }
    state_.store(InterlockState::Armed, std::memory_order_release);
    return {};
}

Result<void> Interlock::beginDelivery() {
    {
        const std::lock_guard lock(mutex_);
        if (state_.load(std::memory_order_relaxed) == InterlockState::Delivering) return {};
    }
    return move(InterlockState::Armed, InterlockState::Delivering, "deliver");
}

Result<void> Interlock::pause() { return move(InterlockState::Delivering, InterlockState::Paused, "pause"); }
Result<void> Interlock::resume() { return move(InterlockState::Paused, InterlockState::Delivering, "resume"); }

void Interlock::disarm(const char* reason) noexcept {
    const std::lock_guard lock(mutex_);
    ticket_ = 0;  // A stop between the two steps voids the first
    switch (state_.load(std::memory_order_relaxed)) {
        case InterlockState::Checking:
        case InterlockState::Armed:
        case InterlockState::Delivering:
        case InterlockState::Paused:
            state_.store(InterlockState::Disarmed, std::memory_order_release);
            reason_ = FixedText<159>(reason);
            break;
        case InterlockState::Disconnected:
        case InterlockState::Disarmed:
        case InterlockState::Faulted:
            break;
    }
}

void Interlock::fault(FaultCause cause, std::string_view reason) noexcept {
    const std::lock_guard lock(mutex_);
    ticket_ = 0;
    causes_ |= bitOf(cause);
    if (cause == FaultCause::DeviceLost) deviceLost_ = true;
    if (state_.load(std::memory_order_relaxed) != InterlockState::Faulted) {
        state_.store(InterlockState::Faulted, std::memory_order_release);
        reason_ = FixedText<159>(reason);
    }
    if (record_ != nullptr) record_->keepFault(cause, reason);
}

void Interlock::causeGone(FaultCause cause) noexcept {
    const std::lock_guard lock(mutex_);
    causes_ &= ~bitOf(cause);
}

bool Interlock::causePersists(FaultCause cause) const noexcept {
    const std::lock_guard lock(mutex_);
    return (causes_ & bitOf(cause)) != 0;
}

Result<void> Interlock::reset() {
    const std::lock_guard lock(mutex_);
    const InterlockState current = state_.load(std::memory_order_relaxed);
    if (checks(ResetState) && current != InterlockState::Faulted) {
        return fail(ErrorCode::NotArmed, "nothing to reset: the interlock is {}", nameOf(current));
    }
    for (int i = 0; i < kFaultCauseCount; ++i) {
        const auto cause = static_cast<FaultCause>(i);
        if (checks(ResetCause) && (causes_ & bitOf(cause)) != 0) {
            return fail(ErrorCode::NotArmed, "cannot reset while the fault persists: {} ({})", nameOf(cause),
                        reason_.view());
        }
    }
    state_.store(deviceLost_ ? InterlockState::Disconnected : InterlockState::Disarmed, std::memory_order_release);
    deviceLost_ = false;
    reason_ = {};
    if (record_ != nullptr) record_->clearFault();
    return {};
}

bool Interlock::mayCheck() const noexcept {
    const InterlockState now = state();
    return now == InterlockState::Checking || now == InterlockState::Armed || now == InterlockState::Delivering;
}

}  // namespace tacto
