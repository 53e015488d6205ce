// SimulatedCircuit.h - the wires between a simulated source, a load and an oscilloscope: which pulses were driven, and
// exactly which voltage and current they caused.
//
// A train passed to play() runs by itself as time passes: each pulse is computed in closed form at its onset, starting
// from the voltage that the pulse before left on the load's capacitor. cut() and the dead-man time truncate the running
// pulse at that moment. The results depend only on these calls and their times, not on when they are read. The newest
// kKept pulses can be read.
//
// Thread-safety: any thread; cut() is lock-free and never allocates.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/base/Units.h"
#include "core/electrode/LoadResponse.h"
#include "drivers/simulated/CutTime.h"
#include "drivers/simulated/FaultSchedule.h"

namespace tacto::sim {

/// One pulse as a real source makes it, with its ramps.
struct DrivenPulse {
    struct Step {
        DriveSegment drive;
        PulsePart part = PulsePart::LeadingPhase;
    };
    static constexpr std::size_t kMaxSteps = 12;
    std::array<Step, kMaxSteps> steps{};
    std::size_t count = 0;
    DriveSegment rest;  ///< state of the source afterwards; its duration is ignored
    void add(const DriveSegment& drive, PulsePart part) noexcept {
        if (drive.duration_s > 0 && count < kMaxSteps) steps[count++] = {drive, part};
    }
    [[nodiscard]] double duration_s() const noexcept;
};

struct DrivenTrain {
    DrivenPulse pulse;
    double onset_s = 0;
    int pulses = 1;
    double period_s = 0.01;  ///< from one onset to the next
    double sourceOhm = 0;    ///< output resistance; forms a voltage divider with the load's d.c. resistance
    SourceLimits limits;
};

/// One pulse that was played.
struct PlayedPulse {
    std::uint64_t number = 0;  ///< number of the pulse, from 1 over the circuit's life
    double onset_s = 0;
    double end_s = 0;                   ///< when the drive ends
    std::vector<ResponsePiece> pieces;  ///< start_s counts from onset_s; the last pieces are the tail after end_s
    PulseTotals totals;                 ///< sums over the pulse and its tail
    bool cut = false;
};

class SimulatedCircuit {
public:
    static constexpr std::size_t kKept = 512;
    static constexpr double kTail_s = 0.5;

    /// Connects `load` at `now`, with an empty capacitor. A running train continues into it from its next pulse on.
    void fit(const Load& load, Instant now);
    [[nodiscard]] Load load() const;
    /// Open, Short and StuckOn act on the circuit; the stimulator handles the other faults.
    void setFaults(const FaultSchedule& faults);

    /// Plays `train` from its onset on, with output allowed until `allowedUntil`. A running train ends at `now`.
    void play(const DrivenTrain& train, Instant now, Instant allowedUntil);
    /// Moves the dead-man time, unless it has already ended the output.
    void allowUntil(Instant moment, Instant now);
    /// Switches the output off at `now`. Only the next play() switches it on again.
    void cut(Instant now) noexcept { cut_.cut(now); }

    [[nodiscard]] bool active(Instant now);
    /// Returns how many trains have begun.
    [[nodiscard]] std::uint64_t trainsBegun(Instant now);
    /// Returns the sums of the newest pulse that has ended by `now`.
    [[nodiscard]] std::optional<PulseTotals> lastPulse(Instant now);

    /// Calls `look(pulses)` with the pulses that began by `now`, oldest first, while the lock is held.
    template <class Look>
    auto inspect(Instant now, Look&& look) {
        const std::lock_guard lock(mutex_);
        advance(toSeconds(now));
        return look(static_cast<const std::deque<PlayedPulse>&>(pulses_));
    }

private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    /// What is needed to compute a pulse again in a shorter form.
    struct Recipe {
        DrivenPulse pulse;
        SourceLimits limits;
        Circuit circuit;
        double startVoltage = 0;      ///< the capacitor's voltage at onset
        double capacitorVoltage = 0;  ///< the capacitor's voltage when the drive ended
    };

    void advance(double now_s);
    void begin(double onset_s, double end_s);
    void compute(PlayedPulse& into, double end_s);
    [[nodiscard]] Circuit circuitAtOnset(double onset_s, const DrivenPulse& pulse, const SourceLimits& limits) const;
    [[nodiscard]] double residualAt(double t_s) const noexcept;
    [[nodiscard]] double endOfOutput() const noexcept;

    mutable std::mutex mutex_;
    CutTime cut_;
    // Guarded by mutex_, like everything below.
    double allowedUntil_ = kInfinity;
    Load load_;
    double fitted_s_ = 0;
    FaultSchedule faults_;
    std::optional<DrivenTrain> train_;
    int pulse_ = 0;  // the next pulse of the train to play
    double trainOnset_ = 0;
    std::uint64_t trains_ = 0;
    std::deque<PlayedPulse> pulses_;
    std::uint64_t played_ = 0;
    Recipe last_;
    bool loadChanged_ = false;  // true if the load changed since the newest pulse
};

}  // namespace tacto::sim
