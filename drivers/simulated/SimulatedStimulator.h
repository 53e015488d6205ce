// SimulatedStimulator.h - a voltage or current source with the flaws of a real source: gain and offset errors of
// amplitude and times, DAC steps, finite rise time, compliance and current limit, latency and timing jitter, charge
// imbalance, a dead-man switch, and a read-back with its own noise.
//
// Ramps keep the width at 50 % and the charge as asked for: each phase begins to rise at its onset and to fall one
// phase width later, into the gap; a source that opens its output in the gap lets go half an edge later.
//
// Thread-safety: as Stimulator; forceOff() is lock-free.
#pragma once

#include <atomic>
#include <memory>

#include "core/devices/Stimulator.h"
#include "drivers/simulated/FastNoise.h"
#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/World.h"

namespace tacto::sim {

struct StimulatorSettings {
    SourceTraits traits;
    KnownLines calibration;  ///< what the source states of itself; empty: it does not know
    double gain = 1;
    double offset = 0;             ///< added to the magnitude of every phase, in V or A
    double imbalance = 0;          ///< share by which the second phase is weaker
    double widthGain = 1;          ///< factor on the width of both phases
    Seconds widthError{0};         ///< added to each phase
    Seconds gapError{0};           ///< added to the gap, if there is one
    double droop = 0;              ///< share by which each phase sags from its beginning to its end
    double overshoot = 0;          ///< share added in each phase's first kOvershoot
    double coldGain = 0;           ///< relative gain error at opening; decays with the time constant kWarmUp
    double sourceOhm = 0;          ///< output resistance of a voltage source
    Seconds rise{100e-9};          ///< 0 to 100 % of an edge
    Seconds latency{200e-6};       ///< from the command to the onset
    Seconds jitter{2e-6};          ///< standard deviation of the onset
    double readBackNoise = 0.002;  ///< relative standard deviation
    FaultSchedule faults;
    std::uint64_t seed = 1;
};

/// Limits stated in the twin's data sheet; the flaws are drawn within these limits (science.md section 12).
struct StimulatorStatement {
    double gain = 0.005;       ///< relative
    double offset_v = 0.02;    ///< of a voltage source
    double offset_ma = 0.005;  ///< of a current source
    double coldGain = 0.002;   ///< relative
    double droop = 0.003;      ///< relative
    double overshoot = 0.01;   ///< relative
    double sourceOhm = 2;      ///< of a voltage source
    Seconds timing{20e-9};     ///< of a phase or the gap
};

/// Returns `settings` with flaws drawn from its seed; the traits state their limits.
[[nodiscard]] StimulatorSettings drawnFlaws(const StimulatorSettings& settings);

class SimulatedStimulator final : public Stimulator, public StatesCalibration, public WorldMember {
public:
    static constexpr Seconds kLateness{0.06};        ///< delay during the fault "late": longer than any caller waits
    static constexpr double kDriftPerSecond = 0.02;  ///< gain per second during the fault "drift", up to kMaxDrift
    static constexpr double kMaxDrift = 0.5;
    static constexpr Seconds kOvershoot{3e-6};
    static constexpr Seconds kWarmUp{120};

    SimulatedStimulator(DeviceIdentity identity, std::shared_ptr<World> world, const StimulatorSettings& settings);
    ~SimulatedStimulator() override { forceOff(); }
    SimulatedStimulator(const SimulatedStimulator&) = delete;
    SimulatedStimulator& operator=(const SimulatedStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return settings_.traits; }
    /// Refuses what Stimulator refuses, a train outside its range or in the wrong unit, an expired approval, and a
    /// train while another is in progress.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    [[nodiscard]] Result<StimulatorStatus> status() override;
    [[nodiscard]] Result<void> keepAlive() override;
    void forceOff() noexcept override;
    [[nodiscard]] const KnownLines& statedCalibration() const noexcept override { return settings_.calibration; }
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

    /// Returns the pulse that this source makes of `train` at `now`, without a load; depends on nothing else but drift.
    [[nodiscard]] DrivenPulse drivenPulse(const PulseTrain& train, Instant now) const;

private:
    [[nodiscard]] Result<void> accepts(const PulseTrain& train) const;
    [[nodiscard]] Result<void> answers(Instant now) const;
    [[nodiscard]] Instant allowedUntil(Instant now) const noexcept;

    const DeviceIdentity identity_;
    const std::shared_ptr<World> world_;
    const StimulatorSettings settings_;
    FastNoise timing_, meter_;
    const Instant opened_;
    std::atomic<std::uint64_t> offs_{0};  // number of forceOff() calls, so that deliver() notices one
};

}  // namespace tacto::sim
