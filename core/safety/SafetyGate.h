// SafetyGate.h - the only place that turns a request into something a driver will accept.
//
// Drivers take ApprovedTrain, never PulseTrain, and only SafetyGate can make an ApprovedTrain. So the compiler proves
// that every output was checked; this does not depend on reviews. Switching an output off needs no approval: see
// Stimulator::forceOff().
//
// An approval can be used once, expires 100 ms after it was granted, and is void after any stop. Its exposure is booked
// on the meter when it is granted, so that approvals not yet delivered cannot add up to more than a limit.
//
// Thread-safety: latchStop() and isCurrent() may be called from any thread and never block; the rest has
// one caller at a time (the control loop).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/encoding/PulseTrain.h"
#include "core/safety/GateSetup.h"

namespace tacto {

class UnitRecord;
namespace gate {
struct AskedTrain;
struct State;
}  // namespace gate

/// Proof that a PulseTrain passed the gate. Move-only: one approval, one delivery.
class ApprovedTrain {
public:
    ApprovedTrain(ApprovedTrain&&) noexcept = default;
    ApprovedTrain& operator=(ApprovedTrain&&) noexcept = default;
    ApprovedTrain(const ApprovedTrain&) = delete;
    ApprovedTrain& operator=(const ApprovedTrain&) = delete;

    [[nodiscard]] const PulseTrain& train() const noexcept { return train_; }
    [[nodiscard]] Seconds interval() const noexcept { return interval_; }
    [[nodiscard]] Instant expires() const noexcept { return expires_; }
    /// The limit that it came nearest to when it was judged, with the trains before it.
    [[nodiscard]] const NearestLimit& nearest() const noexcept { return nearest_; }

private:
    friend class SafetyGate;
    ApprovedTrain(const PulseTrain& train, Seconds interval, std::uint64_t epoch, Instant expires,
                  const NearestLimit& nearest) noexcept
        : train_(train), interval_(interval), epoch_(epoch), expires_(expires), nearest_(nearest) {}
    PulseTrain train_;
    Seconds interval_;
    std::uint64_t epoch_;
    Instant expires_;
    NearestLimit nearest_;
};

/// One vibration of a massager: the mechanical counterpart of a pulse train.
struct VibrationBurst {
    double intensity = 0;   ///< 0..1
    Seconds duration{0.1};  ///< ≤ 1 s
};

/// Proof that a VibrationBurst passed the gate. Move-only.
class ApprovedBurst {
public:
    ApprovedBurst(ApprovedBurst&&) noexcept = default;
    ApprovedBurst& operator=(ApprovedBurst&&) noexcept = default;
    ApprovedBurst(const ApprovedBurst&) = delete;
    ApprovedBurst& operator=(const ApprovedBurst&) = delete;
    [[nodiscard]] const VibrationBurst& burst() const noexcept { return burst_; }
    [[nodiscard]] Instant expires() const noexcept { return expires_; }

private:
    friend class SafetyGate;
    ApprovedBurst(const VibrationBurst& burst, std::uint64_t epoch, Instant expires) noexcept
        : burst_(burst), epoch_(epoch), expires_(expires) {}
    VibrationBurst burst_;
    std::uint64_t epoch_;
    Instant expires_;
};

/// A request: a train already rounded to the device's step (see rounding in GateSetup.h), and the shortest interval,
/// onset to onset, at which similar trains may follow.
struct TrainRequest {
    PulseTrain train;
    Seconds interval{2};
    Instant onset{0};  ///< as planned; at most 100 ms ahead, because the approval expires then
};

class SafetyGate {
public:
    explicit SafetyGate(const Clock& clock);
    ~SafetyGate();

    /// Begins with the unit's deliveries of the last seconds, and writes each train into `record` before handing out
    /// its approval. Before the first configure(); `record` outlives the gate.
    void continueFrom(UnitRecord& record) noexcept;

    /// Sets what is connected and what is allowed. Voids every approval; the meter keeps its bookings. After an error
    /// nothing is approved until a configure() succeeds. Errors: InvalidArgument naming what is missing or impossible
    /// (no limit set, too many limits, a loosened ceiling, monophasic or a voltage source for a person, no consent, no
    /// electrode area for a person ...).
    [[nodiscard]] Result<void> configure(const GateSetup& setup);

    /// Takes a newer |Z|, measured in a check pulse or a train's read-back. Person mode judges with 0.7 to 1.3 times
    /// this |Z|; on a bench load it must agree with the declared range. Ignores a reading older than the last.
    /// Errors: LimitExceeded if |Z| lies outside the profile's (bench: the declared) range, or, for a person, has
    /// doubled or halved since the last good reading (an electrode that lifts or slips, H3); InvalidArgument for NaN,
    /// 0 or less, or a time stamp in the future. After an error only check pulses are approved until a good reading.
    [[nodiscard]] Result<void> updateImpedance(Ohms magnitude, Instant at);

    /// Checks `request` against every limit, in the worst case over the permitted load range, at its interval and with
    /// the exposure already booked in the last 5 s.
    /// Errors: InvalidArgument if a value is negative, not finite or not on the device's grid; NotArmed before
    /// configure(); LimitExceeded naming the first limit broken, its value and its source, or while the unit rests
    /// because its past is not known. Never reduces a value to fit.
    [[nodiscard]] Result<ApprovedTrain> approve(const TrainRequest& request);

    /// Approves one impedance check pulse at the device's smallest check amplitude, after the same checks as approve().
    [[nodiscard]] Result<ApprovedTrain> approveCheck(Instant onset);

    /// Errors: InvalidArgument outside 0..1 or not finite, or longer than 1 s; LimitExceeded for a person at
    /// electrodes; at a massager, above the accepted level plus one step or above a level called too strong.
    [[nodiscard]] Result<ApprovedBurst> approve(const VibrationBurst& burst);

    /// For person mode (H6, see AcceptedLevels.h). Notes that the participant accepted the level of `train`; otherwise
    /// the next may not rise. Errors: NotArmed outside person mode; LimitExceeded for a level never permitted.
    [[nodiscard]] Result<void> accept(const PulseTrain& train);
    /// Notes that the participant called `level` uncomfortable: for this participant no level exceeds it any more.
    /// Voids every approval. Errors: NotArmed outside person mode; InvalidArgument unless finite and ≥ 0.
    [[nodiscard]] Result<void> reportDiscomfort(Milliamps level);
    /// Both work as for levels, for a person at a massager (see AcceptedLevels.h). Errors: NotArmed for anyone else;
    /// InvalidArgument unless 0 to 1; acceptIntensity(): LimitExceeded for an intensity that was not permitted.
    [[nodiscard]] Result<void> acceptIntensity(double intensity);
    [[nodiscard]] Result<void> reportUncomfortable(double intensity);
    /// Returns the highest intensity that a burst may have now; nothing unless a person is at a massager.
    [[nodiscard]] std::optional<double> intensityCeiling() const noexcept;
    /// Begins an ascending series: its ceiling is one step above its last accepted level. Voids every approval.
    void beginAscending() noexcept;
    void endAscending() noexcept;
    /// Returns the highest current that a train of this kind may have now; nothing outside person mode.
    [[nodiscard]] std::optional<Milliamps> levelCeiling(const PulseTrain& train) const noexcept;

    /// Voids every approval handed out so far, for good.
    void latchStop() noexcept;

    /// True unless latchStop() or configure() ran after `approved` was granted, or the approval expired. The device
    /// thread asks this immediately before it writes to the wire.
    [[nodiscard]] bool isCurrent(const ApprovedTrain& approved) const noexcept {
        return isCurrent(approved.epoch_, approved.expires_);
    }
    [[nodiscard]] bool isCurrent(const ApprovedBurst& approved) const noexcept {
        return isCurrent(approved.epoch_, approved.expires_);
    }

    /// The range in which a programmed amplitude may come out, as the gate judges it; V or mA. NaN before configure().
    struct Amplitudes {
        double least, most;
    };
    [[nodiscard]] Amplitudes amplitudes(double programmed) const noexcept;

    /// Fills `rows` with the exposure booked in the last 5 s, each row with its limit, for display. Does not allocate
    /// if `rows` has enough capacity.
    void exposure(std::vector<ExposureRow>& rows) const;

private:
    [[nodiscard]] Result<ApprovedTrain> grant(const gate::AskedTrain& asked, std::uint64_t epoch);
    [[nodiscard]] bool isCurrent(std::uint64_t epoch, Instant expires) const noexcept;
    const Clock& clock_;
    std::atomic<std::uint64_t> epoch_;  // starts differently in every gate, so that no gate accepts another's approval
    std::unique_ptr<gate::State> state_;
};

}  // namespace tacto
