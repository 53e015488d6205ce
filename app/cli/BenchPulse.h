// BenchPulse.h - one pulse into a declared bench load, under the rules for every output: judged by the gate, permitted
// by the interlock in two steps, preceded by an impedance check pulse, and read back. If the check finds the load open,
// shorted or not as declared, no pulse follows (H3).
//
// Thread-safety: stop() any thread; everything else has one caller. deliver() blocks for less than a second, or for up
// to eight more if the unit must rest (UnitRecord.h).
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
    Load load;         ///< as declared; ± 20 % is accepted
    std::vector<LimitSet> limits;
    Ceilings ceilings;                               ///< the ceilings of the profile
    std::optional<SquareCentimetres> electrodeArea;  ///< without it, density limits are not evaluated
    bool resetFault =
        false;  ///< true: resets a fault left by an earlier run if its cause is gone; false: such a fault ends this run
};

/// The measurements of one pulse.
struct PulseFinding {
    Milliamps current{0};
    ElectrodeState electrode = ElectrodeState::NotMeasured;
    std::optional<Ohms> impedance;                     ///< |Z| at the end of the leading phase
    std::optional<sciencemode::SampledPulse> samples;  ///< magnitudes, without sign
};

struct PulseOutcome {
    PulseFinding check;
    std::optional<PulseFinding> pulse;  ///< nothing: the pulse was not sent
    std::string verdict;                ///< "pass", "fail", or "indeterminate" if |Z| was not measured
    std::vector<std::string> reasons;   ///< sentences; empty if it passed
    [[nodiscard]] const PulseFinding& last() const noexcept { return pulse ? *pulse : check; }
};

class BenchPulse {
public:
    /// `device` and `clock` must outlive this. Errors: as SafetyGate::configure(); NotArmed for a unit left in a fault
    /// that is not reset.
    [[nodiscard]] static Result<std::unique_ptr<BenchPulse>> create(PulseOrder order,
                                                                    sciencemode::ScienceModeStimulator& device,
                                                                    const Clock& clock);
    ~BenchPulse();  ///< switches the output off
    BenchPulse(const BenchPulse&) = delete;
    BenchPulse& operator=(const BenchPulse&) = delete;

    /// Step one of two: checks whether the gate would now allow check and pulse. Delivers nothing. Errors: as
    /// SafetyGate::approve().
    [[nodiscard]] Result<void> request();
    /// Step two, within 30 s and after the operator's confirmation. Errors: NotArmed if too late; Stopped;
    /// LimitExceeded; Device or Timeout, with the output switched off.
    [[nodiscard]] Result<PulseOutcome> deliver();
    /// Switches the output off; nothing is delivered afterwards. Never fails.
    void stop() noexcept;
    [[nodiscard]] bool stopped() const noexcept { return stopped_; }

    /// |Z| of the declared load for this pulse, and the limits of the accepted range.
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
    std::unique_ptr<UnitRecord> record_;  // before its writers, to outlive them; null: simulated
    SafetyGate gate_;
    Interlock interlock_;
    Heartbeat heartbeat_;
    StimulatorSession session_;
    std::uint64_t ticket_ = 0;
    std::atomic<bool> stopped_{false};
};

}  // namespace tacto::cli
