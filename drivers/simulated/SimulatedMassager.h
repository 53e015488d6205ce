// SimulatedMassager.h - a massager with a motor to which a simulated accelerometer may be fastened.
//
// Thread-safety: as Massager; forceOff() is lock-free.
#pragma once

#include <memory>

#include "core/devices/Stimulator.h"
#include "drivers/simulated/FaultSchedule.h"
#include "drivers/simulated/Motor.h"
#include "drivers/simulated/World.h"

namespace tacto::sim {

struct MassagerSettings {
    MotorSettings motor;
    double step = 0;  ///< step between intensities; 0: any intensity
    FaultSchedule faults;
};

class SimulatedMassager final : public Massager, public WorldMember {
public:
    /// Stores its motor in the world.
    SimulatedMassager(DeviceIdentity identity, std::shared_ptr<World> world, const MassagerSettings& settings);
    ~SimulatedMassager() override { forceOff(); }
    SimulatedMassager(const SimulatedMassager&) = delete;
    SimulatedMassager& operator=(const SimulatedMassager&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] Result<void> vibrate(ApprovedBurst&& burst) override;
    [[nodiscard]] double step() const noexcept override { return settings_.step; }
    void forceOff() noexcept override { motor_->cut(world_->clock().now()); }
    [[nodiscard]] const std::shared_ptr<World>& world() const noexcept override { return world_; }

    /// Returns the motion of the motor at `moment`. Any thread.
    [[nodiscard]] Motor::Vibration vibrationAt(Instant moment) const { return motor_->at(moment); }

private:
    const DeviceIdentity identity_;
    const std::shared_ptr<World> world_;
    const MassagerSettings settings_;
    const std::shared_ptr<Motor> motor_;
};

}  // namespace tacto::sim
