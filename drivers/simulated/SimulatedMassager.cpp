#include "drivers/simulated/SimulatedMassager.h"

#include <cmath>

#include "core/devices/Device.h"

namespace tacto::sim {

SimulatedMassager::SimulatedMassager(DeviceIdentity identity, std::shared_ptr<World> world,
                                     const MassagerSettings& settings)
    : identity_(std::move(identity)),
      world_(std::move(world)),
      settings_(settings),
      motor_(std::make_shared<Motor>(settings.motor)) {
    world_->setMotor(motor_);
}

Result<void> SimulatedMassager::vibrate(ApprovedBurst&& burst) {
    const ApprovedBurst consumed = std::move(burst);
    const Instant now = world_->clock().now();
    if (auto there = settings_.faults.plugged("massager", now); !there) return there;
    if (auto current = notExpired(consumed.expires(), now, "the simulated massager", "a burst"); !current)
        return current;
    const double asked = consumed.burst().intensity;
    const double level = settings_.step > 0 ? std::round(asked / settings_.step) * settings_.step : asked;
    const bool stuck = settings_.faults.active(Fault::StuckOn, now);
    motor_->start(now, level, stuck ? CutTime::kNever : now + toInstant(consumed.burst().duration));
    if (settings_.faults.active(Fault::Late, now)) {
        return fail(ErrorCode::Timeout, "the simulated massager did not answer within 50 ms");
    }
    return {};
}

}  // namespace tacto::sim
