// SimulatedMassager.h - a vibration motor with an eccentric mass: it takes time to spin up and to run down.
//
// Speed follows the command as a critically damped second-order system, in closed form between commands; the
// vibration's amplitude goes with the square of speed and its frequency with speed.
//
// Thread-safety: as Massager; forceOff() is lock-free.
#pragma once

#include <atomic>
#include <limits>
#include <memory>

#include "core/devices/Massager.h"
#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/World.h"

namespace tacto::sim {

struct MassagerSettings {
    Seconds spinUp{0.03};  ///< time constant
    Hertz topFrequency{180};
    double topAcceleration_m_s2 = 15;  ///< amplitude at full speed
    FaultSchedule faults;
};

class SimulatedMassager final : public Massager, public WorldMember {
public:
    struct Vibration {
        double amplitude_m_s2 = 0;
        double frequency_hz = 0;
    };

    SimulatedMassager(DeviceIdentity identity, std::shared_ptr<World> world, const MassagerSettings& settings);
    ~SimulatedMassager() override { forceOff(); }
    SimulatedMassager(const SimulatedMassager&) = delete;
    SimulatedMassager& operator=(const SimulatedMassager&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] Result<void> vibrate(ApprovedBurst&& burst) override;
    void forceOff() noexcept override;
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

    /// What a hand on it would feel at `moment`, which is at or after the newest command. The device's thread.
    [[nodiscard]] Vibration vibrationAt(Instant moment) const noexcept;

private:
    struct Motion {
        double speed = 0;  ///< 1 = full
        double rate = 0;   ///< 1/s
    };
    [[nodiscard]] Motion run(Motion from, double command, double seconds) const noexcept;
    [[nodiscard]] Motion motionAt(double t_s) const noexcept;

    const DeviceIdentity identity_;
    const std::shared_ptr<World> world_;
    const MassagerSettings settings_;
    Motion start_;  // at start_s_, when the newest burst began
    double start_s_ = 0;
    double command_ = 0;
    double end_s_ = 0;  // of the burst by itself
    std::atomic<Instant::rep> cut_{std::numeric_limits<Instant::rep>::max()};
};

}  // namespace tacto::sim
