// SimulatedStimulator.h - a voltage or current source with the flaws of a real one: gain and offset error of amplitude
// and times, DAC steps, finite rise time, compliance and current limit, latency and timing jitter, charge imbalance, a
// dead-man switch, and a read-back that measures with its own noise.
//
// Ramps are placed so that width at 50 % and charge stay those asked for: each phase begins to rise at its onset and to
// fall one phase width later, into the gap; a source that opens its output in the gap lets go half an edge later.
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
    KnownLines calibration;  ///< its own statement; nothing: it does not know
    double gain = 1;
    double offset = 0;             ///< V or A added to the magnitude of every phase
    double imbalance = 0;          ///< the second phase is weaker by this fraction
    double widthGain = 1;          ///< the gain of both phases' width
    Seconds widthError{0};         ///< added to each phase
    Seconds gapError{0};           ///< added to the gap, where there is one
    double droop = 0;              ///< how far each phase sags from its beginning to its end
    double overshoot = 0;          ///< added in each phase's first kOvershoot
    double coldGain = 0;           ///< relative, when it is opened; gone with the time constant kWarmUp
    double sourceOhm = 0;          ///< a voltage source's
    Seconds rise{100e-9};          ///< 0 to 100 % of an edge
    Seconds latency{200e-6};       ///< from the command to the onset
    Seconds jitter{2e-6};          ///< the onset's, s.d.
    double readBackNoise = 0.002;  ///< relative, s.d.
    FaultSchedule faults;
    std::uint64_t seed = 1;
};

/// The statements in the twin's data sheet; its flaws are drawn within them (science.md section 12).
struct StimulatorStatement {
    double gain = 0.005;       ///< relative
    double offset_v = 0.02;    ///< a voltage source's
    double offset_ma = 0.005;  ///< a current source's
    double coldGain = 0.002;   ///< relative
    double droop = 0.003;      ///< relative
    double overshoot = 0.01;   ///< relative
    double sourceOhm = 2;      ///< a voltage source's
    Seconds timing{20e-9};     ///< for a phase and for the gap
};

/// `settings` with flaws drawn from its seed; their accuracy is stated in its traits.
[[nodiscard]] StimulatorSettings drawnFlaws(const StimulatorSettings& settings);

class SimulatedStimulator final : public Stimulator, public StatesCalibration, public WorldMember {
public:
    static constexpr Seconds kLateness{0.06};        ///< how late the fault "late" makes it: longer than anyone waits
    static constexpr double kDriftPerSecond = 0.02;  ///< gain per second while the fault "drift" lasts, up to kMaxDrift
    static constexpr double kMaxDrift = 0.5;
    static constexpr Seconds kOvershoot{3e-6};
    static constexpr Seconds kWarmUp{120};

    SimulatedStimulator(DeviceIdentity identity, std::shared_ptr<World> world, const StimulatorSettings& settings);
    ~SimulatedStimulator() override { forceOff(); }
    SimulatedStimulator(const SimulatedStimulator&) = delete;
    SimulatedStimulator& operator=(const SimulatedStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return settings_.traits; }
    /// Refuses, besides what Stimulator says, a train outside its range, in the other source's unit, expired, or while
    /// another is in progress.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    [[nodiscard]] Result<StimulatorStatus> status() override;
    [[nodiscard]] Result<void> keepAlive() override;
    void forceOff() noexcept override;
    [[nodiscard]] const KnownLines& statedCalibration() const noexcept override { return settings_.calibration; }
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

    /// The pulse that this source makes of `train` at `now`, before any load: pure, apart from drift.
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
    std::atomic<std::uint64_t> offs_{0};  // counts forceOff(), so that a train in flight notices one
};

}  // namespace tacto::sim
