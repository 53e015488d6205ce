// SimulatedOscilloscope.h - two channels on the simulated load: the voltage across it and the current through a shunt.
//
// Nothing is sampled between triggers. A capture is rendered from the circuit's exact pieces, each passed through the
// instrument's first-order bandwidth in closed form too, then given gain and offset error, noise and quantisation, and
// clipped at the range. The sample clock runs freely: a trigger falls anywhere between two samples, and its time stamp
// is exact, as an instrument's trigger interpolator makes it.
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

/// The statements in the twin's data sheet: half-widths. Its flaws are drawn within them (science.md section 12).
struct ScopeStatement {
    bool states = true;         ///< false: nothing of what follows (`accuracy=unknown`)
    double gain = 0.005;        ///< relative; both channels have the same reference, so one gain error
    double offset = 0.001;      ///< share of the range
    double linearity = 0.0005;  ///< share of the range
    double shunt = 0.001;       ///< relative
    double timeBase = 10e-6;    ///< relative
};

struct ScopeFlaws {
    double noise = 1e-4;                        ///< r.m.s., of the range
    double gain = 1, offset = 0;                ///< the voltage channel's gain and offset; the offset in V
    double currentGain = 1, currentOffset = 0;  ///< offset in A
    double rangeOffset = 0;                     ///< both channels' offset, as a share of the range
    double bow = 0;                             ///< largest departure from the straight line, as a share of the range
    double currentBow = 0;                      ///< largest departure from the straight line of the current channel
    /// What it states of a time since it was armed, over that time; a computer's clock is off the other way.
    double timeBase = 1;
    ScopeStatement stated;
    FaultSchedule faults;
    std::uint64_t seed = 1;
};

/// Gains, offset, bow and time base drawn from `seed` within what is stated; the rest as in `otherwise`.
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
    /// The true time from one sample to the next.
    [[nodiscard]] double step_s() const noexcept { return 1 / settings_.sampleRate.value() / flaws_.timeBase; }
    [[nodiscard]] std::optional<double> findTrigger(const std::deque<PlayedPulse>& pulses) const;
    /// The instrument's reading of a time since it was armed, and back.
    [[nodiscard]] double stated_s(double true_s) const noexcept {
        return armed_s_ + (true_s - armed_s_) * flaws_.timeBase;
    }
    [[nodiscard]] double true_s(double stated_s) const noexcept {
        return armed_s_ + (stated_s - armed_s_) / flaws_.timeBase;
    }
    /// A record around `middle_s`, where a trigger stood unless it is `untriggered`.
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
    double searchFrom_s_ = 0;  // triggers before this are over
    std::optional<double> trigger_s_;
    std::optional<double> forced_s_;  // a record is taken here unless a trigger comes before
    std::vector<double> buffer_;
};

}  // namespace tacto::sim
