// SimulatedCircuit.h - the wires between a simulated source, a load and an oscilloscope: what was driven, and exactly
// what voltage and current that made.
//
// A train handed to play() happens by itself as time passes: each pulse is computed in closed form when its onset is
// reached, from the residual voltage that the one before left on the load's capacitor. cut() truncates what runs, at
// that moment; so does the dead-man time. What is read depends on those calls and their times, not on when anyone
// looked. The newest kKept pulses stay readable.
//
// Thread-safety: every function from any thread; cut() is lock-free and never allocates.
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

/// One pulse as a real source makes it: ramps included.
struct DrivenPulse {
    struct Step {
        DriveSegment drive;
        PulsePart part = PulsePart::LeadingPhase;
    };
    static constexpr std::size_t kMaxSteps = 12;
    std::array<Step, kMaxSteps> steps{};
    std::size_t count = 0;
    DriveSegment rest;  ///< the source's state afterwards; its duration is ignored
    void add(const DriveSegment& drive, PulsePart part) noexcept {
        if (drive.duration_s > 0 && count < kMaxSteps) steps[count++] = {drive, part};
    }
    [[nodiscard]] double duration_s() const noexcept;
};

struct DrivenTrain {
    DrivenPulse pulse;
    double onset_s = 0;
    int pulses = 1;
    double period_s = 0.01;  ///< between pulses
    double sourceOhm = 0;    ///< a voltage source's: its level sags by what the load's d.c. resistance draws
    SourceLimits limits;
};

/// One pulse that happened.
struct PlayedPulse {
    std::uint64_t number = 0;  ///< counts from 1 over the circuit's life
    double onset_s = 0;
    double end_s = 0;                   ///< when the drive ends
    std::vector<ResponsePiece> pieces;  ///< start_s from onset_s; the last ones are the tail after end_s
    PulseTotals totals;                 ///< tail included
    bool cut = false;
};

class SimulatedCircuit {
public:
    static constexpr std::size_t kKept = 512;
    static constexpr double kTail_s = 0.5;

    /// Fits this load from `now` on; its capacitor starts empty. What is playing continues into it at its next pulse.
    void fit(const Load& load, Instant now);
    [[nodiscard]] Load load() const;
    /// Open, Short and StuckOn act on the circuit; the others are the stimulator's own.
    void setFaults(const FaultSchedule& faults);

    /// Starts `train` at its onset and allows output until `allowedUntil`. What was playing ends at `now`.
    void play(const DrivenTrain& train, Instant now, Instant allowedUntil);
    /// Moves the dead-man moment; too late once output has ended by it.
    void allowUntil(Instant moment, Instant now);
    /// Output off at `now`. Undone only by the next play().
    void cut(Instant now) noexcept { cut_.cut(now); }

    [[nodiscard]] bool active(Instant now);
    /// Trains that began so far.
    [[nodiscard]] std::uint64_t trainsBegun(Instant now);
    /// Totals of the newest pulse whose drive has ended by `now`.
    [[nodiscard]] std::optional<PulseTotals> lastPulse(Instant now);

    /// Calls `look(pulses)` with the pulses that began by `now`, oldest first, while nothing changes.
    template <class Look>
    auto inspect(Instant now, Look&& look) {
        const std::lock_guard lock(mutex_);
        advance(toSeconds(now));
        return look(static_cast<const std::deque<PlayedPulse>&>(pulses_));
    }

private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    /// The recipe of a pulse, for making it again shorter.
    struct Recipe {
        DrivenPulse pulse;
        SourceLimits limits;
        Circuit circuit;
        double startVoltage = 0;      ///< the capacitor's voltage at onset
        double capacitorVoltage = 0;  ///< the capacitor's voltage where the drive ended
    };

    void advance(double now_s);
    void begin(double onset_s, double end_s);
    void compute(PlayedPulse& into, double end_s);
    [[nodiscard]] Circuit circuitAtOnset(double onset_s, const DrivenPulse& pulse, const SourceLimits& limits) const;
    [[nodiscard]] double residualAt(double t_s) const noexcept;
    [[nodiscard]] double endOfOutput() const noexcept;

    mutable std::mutex mutex_;
    CutTime cut_;
    // Guarded by mutex_, like all below.
    double allowedUntil_ = kInfinity;
    Load load_;
    double fitted_s_ = 0;
    FaultSchedule faults_;
    std::optional<DrivenTrain> train_;
    int pulse_ = 0;  // the train's pulse that plays next
    double trainOnset_ = 0;
    std::uint64_t trains_ = 0;
    std::deque<PlayedPulse> pulses_;
    std::uint64_t played_ = 0;
    Recipe last_;
    bool loadChanged_ = false;  // the load changed since the newest pulse
};

}  // namespace tacto::sim
