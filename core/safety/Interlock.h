// Interlock.h - decides whether output is permitted at all: the state machine of safety.md.
//
//   Disconnected → Disarmed → Checking → Armed → Delivering ⇄ Paused; Checking, Armed, Delivering and Paused →
//   Disarmed; any state → Faulted, which stays until an explicit reset after its causes are gone.
//
// Two steps lead to Checking: requestArming() and confirmArming(). In Checking only the impedance check may be
// delivered. A transition that is not listed is refused and changes nothing.
//
// Thread-safety: any thread may call anything. state() is lock-free; disarm() and fault() never allocate or throw, and
// wait at most for the few instructions of another caller.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/safety/FixedText.h"

namespace tacto {

enum class InterlockState { Disconnected, Disarmed, Checking, Armed, Delivering, Paused, Faulted };
[[nodiscard]] std::string_view nameOf(InterlockState state) noexcept;  // "disconnected", "disarmed", ...

enum class FaultCause {
    DeviceLost,   ///< unplugged, or no longer answering
    DeviceFault,  ///< garbage, or a refused command
    OpenElectrode,
    ShortElectrode,
    NetCharge,
    StatusMissing,
    LoopSilent,  ///< the heartbeat was lost
    StaleSensor,
    LimitBroken,  ///< a measured value is above a limit
    Internal,     ///< an internal rule of the program is broken
    StuckOn,      ///< the device still delivers after its train should have ended
};
inline constexpr int kFaultCauseCount = 11;
[[nodiscard]] std::string_view nameOf(FaultCause cause) noexcept;  // "open electrode", ...
/// Returns Timeout for a cause that is only lateness (status missing, loop silent, stale sensor), else Device.
[[nodiscard]] ErrorCode codeOf(FaultCause cause) noexcept;

/// The fault in which a unit is or was left.
struct UnitFault {
    std::uint32_t causes = 0;  ///< one bit for each FaultCause
    std::chrono::sys_seconds at{};
    FixedText<159> reason;  ///< of the first cause
};
/// Returns the gravest of the causes after which the output must be checked before it is armed: a device stuck on, a
/// broken limit, net charge, an internal error, in this order. Nothing if `causes` has none of them.
[[nodiscard]] std::optional<FaultCause> graveCause(std::uint32_t causes) noexcept;
/// What asks for a reset. Only a safety check resets a fault with a grave cause; the unit's record holds the fault
/// until the check has passed.
enum class ResetBy { Operator, SafetyCheck };
/// The refusal of every other reset after a grave cause. `of`: the device; `reason`: of the fault.
[[nodiscard]] Error safetyCheckFirst(std::string_view of, FaultCause grave, std::string_view reason);
[[nodiscard]] constexpr std::uint32_t bitOf(FaultCause cause) noexcept { return 1U << static_cast<unsigned>(cause); }

/// How many causes have come since the interlock was made.
struct CausesCame {
    std::uint64_t all = 0;
    std::uint64_t news = 0;  ///< all but those that only repeat a cause that is present and not grave
    friend bool operator==(const CausesCame&, const CausesCame&) = default;
};

/// The evidence that arming needs. By default everything is false or empty: nothing is assumed.
struct ArmingEvidence {
    bool limitsLoaded = false;
    bool deviceIdentified = false;
    bool operatorConfirmed = false;  ///< a deliberate act: not a default button or a repeating key
    bool needsImpedance = true;      ///< false only for a massager
    bool readsBack = true;           ///< the device measures |Z| itself
    std::optional<Ohms> impedance;   ///< from the check pulse, or an oscilloscope reading
    Ohms impedanceLow{0};            ///< with impedanceHigh: the range in which the impedance must lie
    Ohms impedanceHigh{0};
    Instant impedanceAt{0};
    bool declaredLoadConfirmed = false;  ///< replaces a reading if the device cannot read back
};

/// Returns the state of the output after a fault of that cause, as a sentence: "Output is off.", unless the device
/// does not obey.
[[nodiscard]] std::string_view outputAfter(std::optional<FaultCause> cause) noexcept;

class UnitRecord;

class Interlock {
public:
    static constexpr Instant kImpedanceAge = std::chrono::seconds(5);    ///< older readings are not used
    static constexpr Instant kConfirmWithin = std::chrono::seconds(30);  ///< the longest time between the two steps

    [[nodiscard]] InterlockState state() const noexcept { return state_.load(std::memory_order_acquire); }
    /// Returns why the output is faulted or was last disarmed; otherwise empty.
    [[nodiscard]] FixedText<159> reason() const noexcept;
    /// Returns the gravest cause that is still present: as graveCause(), then in the order of FaultCause. Nothing
    /// unless Faulted.
    [[nodiscard]] std::optional<FaultCause> cause() const noexcept;
    /// Returns the error code for reason() while Faulted: Timeout if the first fault was lateness, else Device.
    [[nodiscard]] ErrorCode faultCode() const noexcept;

    /// Returns the fault with all causes since it began, as the unit's record keeps it, or without a record as this
    /// interlock has it (then without a time). Nothing unless Faulted.
    [[nodiscard]] std::optional<UnitFault> unitFault() const noexcept;

    /// Returns the gravest cause since the fault began after which only a safety check resets, as graveCause().
    [[nodiscard]] std::optional<FaultCause> grave() const noexcept;

    /// Keeps faults, until they are reset, in `record`, which outlives the interlock. If the record contains an earlier
    /// fault of the unit, the state becomes Faulted. Call once, after connect().
    void keepFaultsIn(UnitRecord& record) noexcept;

    /// Disconnected → Disarmed: a device is open and identified. `note` is a text for the operator before arming.
    [[nodiscard]] Result<void> connect(std::string_view note = {});
    /// Disarmed → Disconnected. The loss of a device in any other state is a fault.
    [[nodiscard]] Result<void> disconnect();

    /// Step one of two. Changes no state. Errors: NotArmed unless Disarmed.
    [[nodiscard]] Result<std::uint64_t> requestArming(Instant now);
    /// Step two: Disarmed → Checking. Errors: NotArmed for a ticket that is old, used or issued before a stop.
    [[nodiscard]] Result<void> confirmArming(std::uint64_t ticket, Instant now);
    /// Checking → Armed. Errors: NotArmed naming the first missing evidence.
    [[nodiscard]] Result<void> arm(const ArmingEvidence& evidence, Instant now);

    /// Armed → Delivering; no change if already Delivering.
    [[nodiscard]] Result<void> beginDelivery();
    /// Delivering → Paused, Paused → Delivering. Errors: NotArmed from any other state.
    [[nodiscard]] Result<void> pause();
    [[nodiscard]] Result<void> resume();

    /// Checking, Armed, Delivering, Paused → Disarmed. Other states do not change. `reason` is copied.
    void disarm(const char* reason) noexcept;
    /// Any state → Faulted, latched. Keeps the first reason with its `code` (Timeout, or Device for all others); later
    /// causes are added.
    void fault(FaultCause cause, std::string_view reason, ErrorCode code) noexcept;
    void fault(FaultCause cause, std::string_view reason) noexcept { fault(cause, reason, codeOf(cause)); }
    /// Notes that the cause was checked again and is gone. Does not leave Faulted.
    void causeGone(FaultCause cause) noexcept;
    [[nodiscard]] bool causePersists(FaultCause cause) const noexcept;
    /// Errors: NotArmed after a grave cause.
    [[nodiscard]] Result<void> mayReset() const;
    /// Faulted → Disarmed (Disconnected if the device was lost). Errors: NotArmed naming a cause that persists; as
    /// mayReset().
    [[nodiscard]] Result<void> reset();
    /// Notes that all causes of the fault were checked again and are gone, and resets. Refused if a cause has come that
    /// `seen` does not count: `all` as of before the check, `news` as the operator knew them. Errors: NotArmed.
    [[nodiscard]] Result<void> reset(const CausesCame& seen, ResetBy by = ResetBy::Operator);
    [[nodiscard]] CausesCame causesCame() const noexcept;

    /// True if trains may be delivered: in Delivering.
    [[nodiscard]] bool mayDeliver() const noexcept { return state() == InterlockState::Delivering; }
    /// True if an impedance check may be delivered: in Checking; and, to renew an old reading, in Armed and Delivering.
    [[nodiscard]] bool mayCheck() const noexcept;

private:
    [[nodiscard]] Result<void> move(InterlockState from, InterlockState to, const char* what);
    [[nodiscard]] Result<void> leaveFault();  // under the lock, as the next two
    [[nodiscard]] std::optional<UnitFault> faultSinceItBegan() const noexcept;
    [[nodiscard]] Result<void> keptFrom(ResetBy by) const;
    mutable std::mutex mutex_;  // guards everything below against concurrent changes
    std::atomic<InterlockState> state_{InterlockState::Disconnected};
    FixedText<159> reason_;
    ErrorCode faultCode_ = ErrorCode::Device;
    std::uint32_t causes_ = 0;  // one bit for each FaultCause still present
    CausesCame came_;
    FaultCause last_ = FaultCause::DeviceFault;      // the newest of came_.all
    FaultCause lastNews_ = FaultCause::DeviceFault;  // the newest of came_.news
    bool deviceLost_ = false;
    std::uint64_t ticket_ = 0;  // ticket of the pending request; 0 = none
    std::uint64_t lastTicket_ = 0;
    Instant requestedAt_{0};
    UnitRecord* record_ = nullptr;  // the unit's record; null: faults end with the program
};

}  // namespace tacto
