// SafetyGate.h - the only place where a request becomes something a driver will accept.
//
// Drivers take ApprovedTrain, never PulseTrain, and only SafetyGate can make an ApprovedTrain, so "every
// output was checked" is a property the compiler proves rather than a review habit. Switching an output
// off needs no approval: see Stimulator::forceOff().
//
// An approval is single-use, expires 100 ms after it was granted, and is void after any stop. Its exposure
// is booked on the meter when it is granted, so that approvals not yet delivered cannot add up to more
// than a limit.
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

private:
    friend class SafetyGate;
    ApprovedTrain(const PulseTrain& train, Seconds interval, std::uint64_t epoch, Instant expires) noexcept
        : train_(train), interval_(interval), epoch_(epoch), expires_(expires) {}
    PulseTrain train_;
    Seconds interval_;
    std::uint64_t epoch_;
    Instant expires_;
};

/// One vibration of a massager: the mechanical stand-in for a pulse train.
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

/// The request: a train already rounded to the device's step (see rounding in GateSetup.h), and the shortest
/// onset-to-onset interval at which trains like it may follow.
struct TrainRequest {
    PulseTrain train;
    Seconds interval{2};
    Instant onset{0};  ///< planned: at most 100 ms ahead, or the approval would expire before it
};

class SafetyGate {
public:
    explicit SafetyGate(const Clock& clock);
    ~SafetyGate();

    /// Begins with what the unit has delivered in the last seconds, and writes each train down in `record` before its
    /// approval is handed out. Before the first configure(); `record` outlives the gate.
    void continueFrom(UnitRecord& record) noexcept;

    /// Says what is connected and what is allowed. Voids every approval; the meter keeps its memory. After an error
    /// nothing is approved until a configure() succeeds. Errors: InvalidArgument naming what is missing or impossible
    /// (no limit set, too many limits, a loosened ceiling, monophasic or a voltage source for a person, no consent, no
    /// electrode area for a person ...).
    [[nodiscard]] Result<void> configure(const GateSetup& setup);

    /// A newer measured |Z|, from a check pulse or a train's read-back. Person mode judges with 0.7 to 1.3 of it; on a
    /// bench load it must agree with the declared range. An older one than the last is ignored.
    /// Errors: LimitExceeded when it lies outside the profile's (bench: the declared) range, or, for a person, has
    /// doubled or halved since the good reading before it (an electrode that lifts or slips, H3); InvalidArgument for
    /// NaN, 0 or less, or a stamp from the future. After an error nothing but check pulses is approved until a good
    /// reading.
    [[nodiscard]] Result<void> updateImpedance(Ohms magnitude, Instant at);

    /// Checks `request` against every limit, worst case over the permitted load range, at its interval, plus
    /// the exposure already booked in the last 5 s.
    /// Errors: InvalidArgument if a value is negative, not finite or not on the device's grid; NotArmed before
    /// configure(); LimitExceeded naming the first limit broken, its value and its source, or while the unit rests
    /// because its past is not known. Never clamps.
    [[nodiscard]] Result<ApprovedTrain> approve(const TrainRequest& request);

    /// Approves one impedance check pulse, at the device's smallest check amplitude, with the same checks as approve().
    [[nodiscard]] Result<ApprovedTrain> approveCheck(Instant onset);

    /// Errors: InvalidArgument outside 0..1 or not finite, or longer than 1 s; LimitExceeded for a person at
    /// electrodes, and for one at a massager above what was accepted and one step, or above what was called too strong.
    [[nodiscard]] Result<ApprovedBurst> approve(const VibrationBurst& burst);

    /// Person mode (H6, see AcceptedLevels.h). accept(): the participant accepted the level of `train`; without it the
    /// next level may not rise. Errors: NotArmed outside person mode; LimitExceeded for a level that was not permitted.
    [[nodiscard]] Result<void> accept(const PulseTrain& train);
    /// The participant called `level` uncomfortable; nothing exceeds it afterwards, also after configure() for the same
    /// participant. Voids every approval. Errors: NotArmed outside person mode; InvalidArgument unless finite and ≥ 0.
    [[nodiscard]] Result<void> reportDiscomfort(Milliamps level);
    /// Both as for levels, for a person at a massager (see AcceptedLevels.h). Errors: NotArmed for anyone else;
    /// InvalidArgument unless 0 to 1; LimitExceeded of acceptIntensity() for an intensity that was not permitted.
    [[nodiscard]] Result<void> acceptIntensity(double intensity);
    [[nodiscard]] Result<void> reportUncomfortable(double intensity);
    /// The highest intensity that a burst may have now; nothing but for a person at a massager.
    [[nodiscard]] std::optional<double> intensityCeiling() const noexcept;
    /// A series of ascending limits: its ceiling is its own last accepted level plus one step. Voids every approval.
    void beginAscending() noexcept;
    void endAscending() noexcept;
    /// The highest current that a train of this kind may have now; nothing outside person mode.
    [[nodiscard]] std::optional<Milliamps> levelCeiling(const PulseTrain& train) const noexcept;

    /// Voids every approval handed out so far. Irreversible for those approvals.
    void latchStop() noexcept;

    /// True unless latchStop() or configure() ran after `approved` was granted, or it expired. The device
    /// thread asks this immediately before it writes to the wire.
    [[nodiscard]] bool isCurrent(const ApprovedTrain& approved) const noexcept {
        return isCurrent(approved.epoch_, approved.expires_);
    }
    [[nodiscard]] bool isCurrent(const ApprovedBurst& approved) const noexcept {
        return isCurrent(approved.epoch_, approved.expires_);
    }

    /// The two amplitudes between which a train that is programmed to `programmed` comes out, as it is judged; V or mA.
    /// NaN before configure().
    struct Amplitudes {
        double least, most;
    };
    [[nodiscard]] Amplitudes amplitudes(double programmed) const noexcept;

    /// The exposure booked in the last 5 s, each row against its limit, for the exposure display. Does not allocate
    /// when `rows` has capacity.
    void exposure(std::vector<ExposureRow>& rows) const;

private:
    [[nodiscard]] Result<ApprovedTrain> grant(const gate::AskedTrain& asked, std::uint64_t epoch);
    [[nodiscard]] bool isCurrent(std::uint64_t epoch, Instant expires) const noexcept;
    const Clock& clock_;
    std::atomic<std::uint64_t> epoch_;  // Starts apart in every gate, so that no gate honours another's approval
    std::unique_ptr<gate::State> state_;
};

}  // namespace tacto
