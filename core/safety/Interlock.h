// Interlock.h - whether output is permitted at all: the state machine of safety.md.
//
//   Disconnected → Disarmed → Checking → Armed → Delivering ⇄ Paused; Checking, Armed, Delivering and Paused →
//   Disarmed; Faulted latches from anywhere and needs an explicit reset after its causes are gone.
//
// Checking is entered by two steps, requestArming() and confirmArming(), and may deliver nothing but the impedance
// check. A transition that is not in the list is refused and changes nothing.
//
// Thread-safety: any thread may call anything. state() is lock-free; disarm() and fault() never
// allocate, never throw and wait at most for another caller's few instructions.
#pragma once

#include <atomic>
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
    DeviceLost,   ///< unplugged, or gone silent
    DeviceFault,  ///< garbage, a refused command
    OpenElectrode,
    ShortElectrode,
    NetCharge,
    StatusMissing,
    LoopSilent,  ///< heartbeat lost
    StaleSensor,
    LimitBroken,  ///< something measured above a limit
    Internal,     ///< a broken invariant
    StuckOn,      ///< the device continues after its train should have ended
};
inline constexpr int kFaultCauseCount = 11;
[[nodiscard]] std::string_view nameOf(FaultCause cause) noexcept;  // "open electrode", ...
/// Timeout for a cause that is lateness alone (status missing, loop silent, stale sensor), else Device.
[[nodiscard]] ErrorCode codeOf(FaultCause cause) noexcept;

/// The evidence that arming needs. Everything false or empty: nothing is assumed.
struct ArmingEvidence {
    bool limitsLoaded = false;
    bool deviceIdentified = false;
    bool operatorConfirmed = false;  ///< deliberate: not a default button, not a key that repeats
    bool needsImpedance = true;      ///< false for a massager alone
    bool readsBack = true;           ///< the device measures |Z| itself
    std::optional<Ohms> impedance;   ///< from the check pulse, or an oscilloscope reading
    Ohms impedanceLow{0};            ///< the range in which it must lie
    Ohms impedanceHigh{0};
    Instant impedanceAt{0};
    bool declaredLoadConfirmed = false;  ///< stands in for a reading where the device cannot read back
};

/// The state of the output after a fault of that cause, as a sentence: "Output is off.", except for a device that does
/// not obey.
[[nodiscard]] std::string_view outputAfter(std::optional<FaultCause> cause) noexcept;

class UnitRecord;

class Interlock {
public:
    static constexpr Instant kImpedanceAge = std::chrono::seconds(5);    ///< older readings do not count
    static constexpr Instant kConfirmWithin = std::chrono::seconds(30);  ///< the time between the two steps

    [[nodiscard]] InterlockState state() const noexcept { return state_.load(std::memory_order_acquire); }
    /// Why it is faulted, or why it was last disarmed; empty otherwise.
    [[nodiscard]] FixedText<159> reason() const noexcept;
    /// The first cause that is still present, StuckOn before the others, then in the order of FaultCause; nothing
    /// unless Faulted.
    [[nodiscard]] std::optional<FaultCause> cause() const noexcept;
    /// The code of an error that tells reason() while Faulted: Timeout where the first fault was lateness, else Device.
    [[nodiscard]] ErrorCode faultCode() const noexcept;

    /// Faults are kept in `record`, which outlives the interlock, until they are reset; one in which the unit was left
    /// before makes it Faulted. Once, after connect().
    void keepFaultsIn(UnitRecord& record) noexcept;

    /// Disconnected → Disarmed: a device is open and identified. `note`: what the operator should know before arming.
    [[nodiscard]] Result<void> connect(std::string_view note = {});
    /// Disarmed → Disconnected. A device lost in any other state is a fault.
    [[nodiscard]] Result<void> disconnect();

    /// Step one of two. Changes no state. Errors: NotArmed unless Disarmed.
    [[nodiscard]] Result<std::uint64_t> requestArming(Instant now);
    /// Step two: Disarmed → Checking. Errors: NotArmed for a ticket that is old, used or from before a stop.
    [[nodiscard]] Result<void> confirmArming(std::uint64_t ticket, Instant now);
    /// Checking → Armed. Errors: NotArmed naming the first thing missing.
    [[nodiscard]] Result<void> arm(const ArmingEvidence& evidence, Instant now);

    /// Armed → Delivering; already Delivering is fine.
    [[nodiscard]] Result<void> beginDelivery();
    /// Delivering → Paused, Paused → Delivering. Errors: NotArmed from any other state.
    [[nodiscard]] Result<void> pause();
    [[nodiscard]] Result<void> resume();

    /// Checking, Armed, Delivering, Paused → Disarmed. Other states stay. `reason` is copied.
    void disarm(const char* reason) noexcept;
    /// → Faulted, latched. The first reason is kept, with its `code` (only Timeout and Device are told apart); further
    /// causes add up.
    void fault(FaultCause cause, std::string_view reason, ErrorCode code) noexcept;
    void fault(FaultCause cause, std::string_view reason) noexcept { fault(cause, reason, codeOf(cause)); }
    /// The cause was looked at again and is no longer there. Does not leave Faulted.
    void causeGone(FaultCause cause) noexcept;
    [[nodiscard]] bool causePersists(FaultCause cause) const noexcept;
    /// Faulted → Disarmed (Disconnected when the device was lost). Errors: NotArmed naming a cause that persists.
    [[nodiscard]] Result<void> reset();

    /// Trains may be delivered: Delivering.
    [[nodiscard]] bool mayDeliver() const noexcept { return state() == InterlockState::Delivering; }
    /// An impedance check may be delivered: Checking, and, to renew an old reading, Armed and Delivering.
    [[nodiscard]] bool mayCheck() const noexcept;

private:
    [[nodiscard]] Result<void> move(InterlockState from, InterlockState to, const char* what);
    mutable std::mutex mutex_;  // Guards everything below against concurrent change
    std::atomic<InterlockState> state_{InterlockState::Disconnected};
    FixedText<159> reason_;
    ErrorCode faultCode_ = ErrorCode::Device;
    std::uint32_t causes_ = 0;  // Bit per FaultCause still present
    bool deviceLost_ = false;
    std::uint64_t ticket_ = 0;  // The pending request's; 0 = none
    std::uint64_t lastTicket_ = 0;
    Instant requestedAt_{0};
    UnitRecord* record_ = nullptr;  // The unit's; null: faults end with the program
};

}  // namespace tacto
