#include "core/safety/Interlock.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/base/Words.h"
#include "core/safety/Rules.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

using namespace gate;

namespace {
constexpr Word<InterlockState> kStates[] = {{"disconnected", InterlockState::Disconnected},
                                            {"disarmed", InterlockState::Disarmed},
                                            {"checking", InterlockState::Checking},
                                            {"armed", InterlockState::Armed},
                                            {"delivering", InterlockState::Delivering},
                                            {"paused", InterlockState::Paused},
                                            {"faulted", InterlockState::Faulted}};
constexpr Word<FaultCause> kCauses[] = {{"device lost", FaultCause::DeviceLost},
                                        {"device fault", FaultCause::DeviceFault},
                                        {"open electrode", FaultCause::OpenElectrode},
                                        {"shorted electrode", FaultCause::ShortElectrode},
                                        {"net charge", FaultCause::NetCharge},
                                        {"status missing", FaultCause::StatusMissing},
                                        {"loop silent", FaultCause::LoopSilent},
                                        {"stale sensor", FaultCause::StaleSensor},
                                        {"limit broken", FaultCause::LimitBroken},
                                        {"internal error", FaultCause::Internal},
                                        {"stuck on", FaultCause::StuckOn}};
static_assert(std::size(kCauses) == kFaultCauseCount);

constexpr std::uint32_t kAllCauses = (1U << kFaultCauseCount) - 1;

/// The causes after which something must be checked before the output is armed, the gravest first. None may hide
/// behind a lesser one, as of a device that is unplugged after it broke a limit.
constexpr std::array kGraveCauses{FaultCause::StuckOn, FaultCause::LimitBroken, FaultCause::NetCharge,
                                  FaultCause::Internal};

/// Returns the gravest of the causes, and of lesser ones the first in the order of FaultCause. `causes` is not 0.
FaultCause gravestOf(std::uint32_t causes) noexcept {
    return graveCause(causes).value_or(static_cast<FaultCause>(std::countr_zero(causes)));
}

// --- what is refused ------------------------------------------------------------------------------------------------

struct Move {
    InterlockState now, from;
    const char* what;
};

constexpr Rule<Move> kMoveRules[] = {
    {InterlockMove, [](auto& m) { return m.now != m.from; },
     [](auto& m) {
         return fail(ErrorCode::NotArmed, "cannot {} while {}; the output must be {}", m.what, nameOf(m.now),
                     nameOf(m.from));
     }},
};

constexpr Rule<InterlockState> kRequestRules[] = {
    {ArmRequestState, [](auto& now) { return now != InterlockState::Disarmed; },
     [](auto& now) {
         return fail(ErrorCode::NotArmed, "cannot start arming while {}; the output must be disarmed", nameOf(now));
     }},
};

constexpr Rule<InterlockState> kConfirmRules[] = {
    {ArmConfirmState, [](auto& now) { return now != InterlockState::Disarmed; },
     [](auto& now) {
         return fail(ErrorCode::NotArmed, "cannot confirm arming while {}; the output must be disarmed", nameOf(now));
     }},
};

struct Ticket {
    std::uint64_t shown, requested;
    Instant requestedAt, now;
};

constexpr Rule<Ticket> kTicketRules[] = {
    {ArmTicket,
     [](auto& t) {
         return !(t.shown != 0 && t.shown == t.requested && t.now >= t.requestedAt &&
                  t.now - t.requestedAt <= Interlock::kConfirmWithin);
     },
     [](auto&) {
         return fail(ErrorCode::NotArmed, "arming was not requested within the last 30 s, or was stopped since");
     }},
};

struct Arming {
    InterlockState state;
    const ArmingEvidence& evidence;
    Instant now;
    [[nodiscard]] bool measured() const noexcept { return evidence.needsImpedance && evidence.impedance; }
    [[nodiscard]] double ohm() const noexcept { return evidence.impedance->value(); }
};

constexpr Rule<Arming> kArmRules[] = {
    {ArmState, [](auto& a) { return a.state != InterlockState::Checking; },
     [](auto& a) {
         return fail(ErrorCode::NotArmed, "cannot arm while {}; the load check must be running", nameOf(a.state));
     }},
    {ArmLimits, [](auto& a) { return !a.evidence.limitsLoaded; },
     [](auto&) { return fail(ErrorCode::NotArmed, "cannot arm: no limit set is loaded"); }},
    {ArmIdentity, [](auto& a) { return !a.evidence.deviceIdentified; },
     [](auto&) { return fail(ErrorCode::NotArmed, "cannot arm: the device is not identified"); }},
    {ArmOperator, [](auto& a) { return !a.evidence.operatorConfirmed; },
     [](auto&) { return fail(ErrorCode::NotArmed, "cannot arm: the operator has not confirmed it"); }},
    {ArmImpedanceMissing,
     [](auto& a) {
         const bool declared = !a.evidence.readsBack && a.evidence.declaredLoadConfirmed;
         return a.evidence.needsImpedance && !a.evidence.impedance && !declared;
     },
     [](auto& a) {
         return fail(ErrorCode::NotArmed, "cannot arm: {}",
                     a.evidence.readsBack
                         ? "no impedance was measured"
                         : "the device reads no impedance back and the declared load is not confirmed");
     }},
    {ArmImpedanceRange,
     [](auto& a) {
         return a.measured() &&
                !(a.ohm() >= a.evidence.impedanceLow.value() && a.ohm() <= a.evidence.impedanceHigh.value());
     },
     [](auto& a) {
         return fail(ErrorCode::NotArmed,
                     "cannot arm: the measured impedance is {:.4g} ohm; {:.4g} to {:.4g} ohm is accepted", a.ohm(),
                     a.evidence.impedanceLow.value(), a.evidence.impedanceHigh.value());
     }},
    {ArmImpedanceAge,
     [](auto& a) {
         const Instant at = a.evidence.impedanceAt;
         return a.measured() && !(at <= a.now && a.now - at <= Interlock::kImpedanceAge);
     },
     [](auto& a) {
         return fail(ErrorCode::NotArmed,
                     "cannot arm: the impedance was measured {:.3g} s ago; at most 5 s is accepted",
                     toSeconds(a.now - a.evidence.impedanceAt));
     }},
};

struct Reset {
    InterlockState state;
    std::uint32_t causes;
    std::string_view reason;
};

constexpr Rule<Reset> kResetRules[] = {
    {ResetState, [](auto& r) { return r.state != InterlockState::Faulted; },
     [](auto& r) { return fail(ErrorCode::NotArmed, "nothing to reset: the output is {}", nameOf(r.state)); }},
    {ResetCause, [](auto& r) { return r.causes != 0; },
     [](auto& r) {
         return fail(ErrorCode::NotArmed, "cannot reset while the fault persists: {} ({})", nameOf(gravestOf(r.causes)),
                     r.reason);
     }},
};

struct Grave {
    ResetBy by;
    std::optional<UnitFault> fault;
    [[nodiscard]] std::optional<FaultCause> cause() const noexcept {
        return fault ? graveCause(fault->causes) : std::nullopt;
    }
};

constexpr Rule<Grave> kGraveRules[] = {
    {ResetGrave, [](auto& g) { return g.by != ResetBy::SafetyCheck && g.cause(); },
     [](auto& g) -> tl::unexpected<Error> {
         return tl::unexpected(safetyCheckFirst("the stimulator", *g.cause(), g.fault->reason.view()));
     }},
};

struct Leaving {
    CausesCame came, seen;
    FaultCause newest, news;
};

constexpr Rule<Leaving> kLeaveRules[] = {
    {ResetSeen, [](auto& l) { return l.came != l.seen; },
     [](auto& l) {
         const bool again = l.came.news == l.seen.news;
         return fail(ErrorCode::NotArmed, "not reset: {} meanwhile, {}. Look into it, then reset again",
                     again ? "the fault came again" : "another cause of the fault came",
                     nameOf(again ? l.newest : l.news));
     }},
};
}  // namespace

std::optional<FaultCause> graveCause(std::uint32_t causes) noexcept {
    for (const auto cause : kGraveCauses)
        if ((causes & bitOf(cause)) != 0) return cause;
    return std::nullopt;
}

Error safetyCheckFirst(std::string_view of, FaultCause grave, std::string_view reason) {
    return {ErrorCode::NotArmed,
            fmt::format("nothing was reset: {} is in a fault of {} ({}). Run the safety check first, load-safety with "
                        "--reset-fault, or open it under “Safety check” in the window",
                        of, nameOf(grave), reason)};
}

std::string_view nameOf(InterlockState state) noexcept { return wordFor(kStates, state); }
std::string_view nameOf(FaultCause cause) noexcept { return wordFor(kCauses, cause); }

ErrorCode codeOf(FaultCause cause) noexcept {
    const bool late =
        cause == FaultCause::StatusMissing || cause == FaultCause::LoopSilent || cause == FaultCause::StaleSensor;
    return late ? ErrorCode::Timeout : ErrorCode::Device;
}

std::string_view outputAfter(std::optional<FaultCause> cause) noexcept {
    return cause == FaultCause::StuckOn ? "The output may still be on." : "Output is off.";
}

FixedText<159> Interlock::reason() const noexcept {
    const std::lock_guard lock(mutex_);
    return reason_;
}

std::optional<FaultCause> Interlock::cause() const noexcept {
    const std::lock_guard lock(mutex_);
    if (state_.load(std::memory_order_relaxed) != InterlockState::Faulted) return std::nullopt;
    const std::uint32_t present = causes_ & kAllCauses;
    return present == 0 ? std::nullopt : std::optional(gravestOf(present));
}

std::optional<UnitFault> Interlock::unitFault() const noexcept {
    const std::lock_guard lock(mutex_);
    return faultSinceItBegan();
}

std::optional<FaultCause> Interlock::grave() const noexcept {
    const std::lock_guard lock(mutex_);
    return Grave{ResetBy::Operator, faultSinceItBegan()}.cause();
}

std::optional<UnitFault> Interlock::faultSinceItBegan() const noexcept {
    if (state_.load(std::memory_order_relaxed) != InterlockState::Faulted) return std::nullopt;
    if (record_ != nullptr)
        if (auto kept = record_->fault()) return kept;
    return UnitFault{causes_ & kAllCauses, {}, reason_};
}

Result<void> Interlock::move(InterlockState from, InterlockState to, const char* what) {
    const std::lock_guard lock(mutex_);
    if (auto kept = judge(kMoveRules, Move{state_.load(std::memory_order_relaxed), from, what}); !kept) return kept;
    state_.store(to, std::memory_order_release);
    if (to != InterlockState::Disarmed) reason_ = {};
    return {};
}

void Interlock::keepFaultsIn(UnitRecord& record) noexcept {
    const std::lock_guard lock(mutex_);
    record_ = &record;
    const auto left = record.fault();
    if (!left) return;
    // An internal error ended with the program that had it; but the device must still be checked.
    const bool internal = (left->causes & bitOf(FaultCause::Internal)) != 0;
    causes_ |= (left->causes & ~bitOf(FaultCause::Internal)) | (internal ? bitOf(FaultCause::DeviceFault) : 0U);
    state_.store(InterlockState::Faulted, std::memory_order_release);
    std::array<char, 160> text{};
    const auto end = fmt::format_to_n(text.data(), text.size() - 1, "left by an earlier run: {}", left->reason.view());
    reason_ = std::string_view(text.data(), std::min(end.size, text.size() - 1));
    faultCode_ = ErrorCode::Device;
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
    if (auto kept = judge(kRequestRules, state_.load(std::memory_order_relaxed)); !kept) return failure(kept);
    ticket_ = ++lastTicket_;
    requestedAt_ = now;
    return ticket_;
}

Result<void> Interlock::confirmArming(std::uint64_t ticket, Instant now) {
    const std::lock_guard lock(mutex_);
    if (auto kept = judge(kConfirmRules, state_.load(std::memory_order_relaxed)); !kept) return kept;
    const Ticket shown{ticket, std::exchange(ticket_, 0), requestedAt_, now};  // each request can be confirmed once
    if (auto kept = judge(kTicketRules, shown); !kept) return kept;
    state_.store(InterlockState::Checking, std::memory_order_release);
    reason_ = {};
    return {};
}

Result<void> Interlock::arm(const ArmingEvidence& evidence, Instant now) {
    const std::lock_guard lock(mutex_);
    const Arming arming{state_.load(std::memory_order_relaxed), evidence, now};
    if (auto kept = judge(kArmRules, arming); !kept) return kept;
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
    ticket_ = 0;  // a stop between the two steps voids the first
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

ErrorCode Interlock::faultCode() const noexcept {
    const std::lock_guard lock(mutex_);
    return faultCode_;
}

void Interlock::fault(FaultCause cause, std::string_view reason, ErrorCode code) noexcept {
    const std::lock_guard lock(mutex_);
    ticket_ = 0;
    ++came_.all;
    last_ = cause;
    if ((causes_ & bitOf(cause)) == 0 || graveCause(bitOf(cause))) {
        ++came_.news;
        lastNews_ = cause;
    }
    causes_ |= bitOf(cause);
    if (cause == FaultCause::DeviceLost) deviceLost_ = true;
    if (state_.load(std::memory_order_relaxed) != InterlockState::Faulted) {
        state_.store(InterlockState::Faulted, std::memory_order_release);
        reason_ = FixedText<159>(reason);
        faultCode_ = code == ErrorCode::Timeout ? ErrorCode::Timeout : ErrorCode::Device;
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

Result<void> Interlock::keptFrom(ResetBy by) const { return judge(kGraveRules, Grave{by, faultSinceItBegan()}); }

Result<void> Interlock::mayReset() const {
    const std::lock_guard lock(mutex_);
    return keptFrom(ResetBy::Operator);
}

Result<void> Interlock::reset() {
    const std::lock_guard lock(mutex_);
    if (auto kept = keptFrom(ResetBy::Operator); !kept) return kept;
    return leaveFault();
}

Result<void> Interlock::reset(const CausesCame& seen, ResetBy by) {
    const std::lock_guard lock(mutex_);
    if (auto kept = judge(kLeaveRules, Leaving{came_, seen, last_, lastNews_}); !kept) return kept;
    const auto fault = faultSinceItBegan();
    if (auto kept = keptFrom(by); !kept) return kept;
    if (record_ != nullptr && fault && graveCause(fault->causes)) record_->holdFault();
    causes_ = 0;
    return leaveFault();
}

CausesCame Interlock::causesCame() const noexcept {
    const std::lock_guard lock(mutex_);
    return came_;
}

Result<void> Interlock::leaveFault() {
    const Reset asked{state_.load(std::memory_order_relaxed), causes_ & kAllCauses, reason_.view()};
    if (auto kept = judge(kResetRules, asked); !kept) return kept;
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
