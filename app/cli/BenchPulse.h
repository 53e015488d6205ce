// BenchPulse.h - one pulse into a declared bench load, by the rules of every output: judged by the gate, permitted by
// the interlock in two steps, after an impedance check pulse, and read back. A load that the check finds open, shorted
// or other than declared gets no pulse (H3).
//
// Thread-safety: stop() any thread; everything else one caller, which deliver() keeps for less than a second, or for
// eight more where the unit must rest (UnitRecord.h).
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "core/bench/delivery/StimulatorSession.h"
#include "core/safety/Interlock.h"
#include "core/safety/UnitRecord.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto::cli {

struct PulseOrder {
    PulseTrain pulse;  ///< one biphasic pulse, in mA
    Load load;         ///< declared; ± 20 % is accepted
    std::vector<LimitSet> limits;
    Ceilings ceilings;                               ///< the profile's own ceilings
    std::optional<SquareCentimetres> electrodeArea;  ///< without it density rows are not evaluated
    bool resetFault =
        false;  ///< whether the state that an earlier run left may stand, if its cause is gone; else it ends this run
};

/// The findings of one pulse.
struct PulseFinding {
    Milliamps current{0};
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<Ohms> impedance;                     ///< |Z| at the end of the leading phase
    std::optional<sciencemode::SampledPulse> samples;  ///< magnitudes
};

struct PulseOutcome {
    PulseFinding check;
    std::optional<PulseFinding> pulse;  ///< nothing: it was not sent
    std::string verdict;                ///< "pass", "fail", or "indeterminate" where |Z| was not measured
    std::vector<std::string> reasons;   ///< sentences, unless it passed
    [[nodiscard]] const PulseFinding& last() const noexcept { return pulse ? *pulse : check; }
};

class BenchPulse {
public:
    /// `device` and `clock` outlive it. Errors: as SafetyGate::configure(); NotArmed for a unit that was left in a
    /// fault which is not reset.
    [[nodiscard]] static Result<std::unique_ptr<BenchPulse>> create(PulseOrder order,
                                                                    sciencemode::ScienceModeStimulator& device,
                                                                    const Clock& clock);
    ~BenchPulse();  ///< output off
    BenchPulse(const BenchPulse&) = delete;
    BenchPulse& operator=(const BenchPulse&) = delete;

    /// Step one of two: whether the gate would let check and pulse pass now. Delivers nothing. Errors: as
    /// SafetyGate::approve().
    [[nodiscard]] Result<void> request();
    /// Step two, within 30 s and after the operator's deliberate word. Errors: NotArmed when it comes late; Stopped;
    /// LimitExceeded; Device or Timeout, with the output switched off.
    [[nodiscard]] Result<PulseOutcome> deliver();
    /// Output off, and nothing more is delivered. Never fails.
    void stop() noexcept;
    [[nodiscard]] bool stopped() const noexcept { return stopped_; }

    /// |Z| of the declared load for such a pulse, and the ends of what is accepted.
    struct Expected {
        Ohms low{0}, nominal{0}, high{0};
    };
    [[nodiscard]] Expected expected() const noexcept;
    [[nodiscard]] const PulseOrder& order() const noexcept { return order_; }

private:
    BenchPulse(PulseOrder order, GateSetup setup, sciencemode::ScienceModeStimulator& device, const Clock& clock);
    [[nodiscard]] Result<void> leaveFault();
    [[nodiscard]] TrainRequest requestNow() const noexcept;
    [[nodiscard]] Result<PulseFinding> send(Result<ApprovedTrain> approved, bool isCheck, Milliamps current);
    [[nodiscard]] TrainReport report();
    void judge(const PulseFinding& finding, bool isCheck, PulseOutcome& into) const;
    [[nodiscard]] Result<void> arm(const PulseFinding& check);

    const PulseOrder order_;
    const GateSetup setup_;
    sciencemode::ScienceModeStimulator& device_;
    const Clock& clock_;
    std::unique_ptr<UnitRecord> record_;  // Outlives those that write into it; null: simulated
    SafetyGate gate_;
    Interlock interlock_;
    Heartbeat heartbeat_;
    StimulatorSession session_;
    std::uint64_t ticket_ = 0;
    std::atomic<bool> stopped_{false};
};

}  // namespace tacto::cli
