// SimulatedOscilloscope.h - an oscilloscope on the simulated load: the voltage across it and the current by a shunt.
//
// Nothing is sampled between triggers. A capture is computed from the circuit's exact pieces: first-order bandwidth in
// closed form, gain and offset error, noise, quantisation, and clipping at the range. The sample clock runs freely: a
// trigger falls anywhere between two samples, and its time stamp is exact, as from an instrument's trigger
// interpolator.
//
// Thread-safety: as Oscilloscope.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/devices/Oscilloscope.h"
#include "drivers/simulated/FastNoise.h"
#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/FilteredTrace.h"
#include "drivers/simulated/World.h"

namespace tacto::sim {

/// Half-widths stated in the twin's data sheet. The flaws are drawn within these limits (science.md section 12).
struct ScopeStatement {
    bool states = true;         ///< false: states nothing (`accuracy=unknown`)
    double gain = 0.005;        ///< relative; one gain error, as both channels share a reference
    double offset = 0.001;      ///< share of the range
    double linearity = 0.0005;  ///< share of the range
    double shunt = 0.001;       ///< relative
    double timeBase = 10e-6;    ///< relative
};

struct ScopeFlaws {
    double noise = 1e-4;                        ///< r.m.s., as a share of the range
    double gain = 1, offset = 0;                ///< of the voltage channel; the offset in V
    double currentGain = 1, currentOffset = 0;  ///< of the current channel; the offset in A
    double rangeOffset = 0;                     ///< offset of both channels, as a share of the range
    double bow = 0;                             ///< largest deviation from a straight line, as a share of the range
    double currentBow = 0;                      ///< the same for the current channel
    /// Stated time since arming divided by true time; a computer's clock is off in the other direction.
    double timeBase = 1;
    ScopeStatement stated;
    FaultSchedule faults;
    std::uint64_t seed = 1;
};

/// Draws gains, offset, bow and time base from `seed` within the stated limits; the rest comes from `otherwise`.
[[nodiscard]] ScopeFlaws drawnFlaws(const ScopeFlaws& otherwise, std::uint64_t seed);

class SimulatedOscilloscope final : public Oscilloscope, public ForcedTrigger, public WorldMember {
public:
    SimulatedOscilloscope(DeviceIdentity identity, std::shared_ptr<World> world, const ScopeTraits& traits,
                          const ScopeFlaws& flaws);

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const ScopeTraits& traits() const noexcept override { return traits_; }
    [[nodiscard]] Result<void> configure(const ScopeSettings& settings) override;
    [[nodiscard]] Result<void> arm() override;
    [[nodiscard]] Result<std::optional<Capture>> poll() override;
    void disarm() noexcept override { armed_ = false; }
    [[nodiscard]] Result<void> forceTrigger() override;
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

private:
    [[nodiscard]] Result<void> answers(Instant now) const;
    /// Returns the true time between two samples.
    [[nodiscard]] double step_s() const noexcept { return 1 / settings_.sampleRate.value() / flaws_.timeBase; }
    [[nodiscard]] std::optional<double> findTrigger(const std::deque<PlayedPulse>& pulses) const;
    /// Converts a true session time to the time that the instrument states.
    [[nodiscard]] double stated_s(double true_s) const noexcept {
        return armed_s_ + (true_s - armed_s_) * flaws_.timeBase;
    }
    [[nodiscard]] double true_s(double stated_s) const noexcept {
        return armed_s_ + (stated_s - armed_s_) / flaws_.timeBase;
    }
    /// Makes a record around `middle_s`, which is the time of a trigger unless `untriggered`.
    [[nodiscard]] Capture render(const std::deque<PlayedPulse>& pulses, double middle_s, bool untriggered);
    void digitise(CaptureChannel& channel, const FilteredTrace& trace, double start_s, double gain, double offset,
                  double bow);

    const DeviceIdentity identity_;
    const std::shared_ptr<World> world_;
    const ScopeTraits traits_;
    double armed_s_ = 0;
    const ScopeFlaws flaws_;
    ScopeSettings wanted_, settings_;
    FastNoise noise_;
    bool armed_ = false;
    double searchFrom_s_ = 0;  // triggers before this time are ignored
    std::optional<double> trigger_s_;
    std::optional<double> forced_s_;  // when a record is taken, unless a trigger comes first
    std::vector<double> buffer_;
};

}  // namespace tacto::sim
