#include "drivers/simulated/SimulatedMassager.h"

#include <algorithm>
#include <cmath>

namespace tacto::sim {

SimulatedMassager::SimulatedMassager(DeviceIdentity identity, std::shared_ptr<World> world,
                                     const MassagerSettings& settings)
    : identity_(std::move(identity)), world_(std::move(world)), settings_(settings) {}

Result<void> SimulatedMassager::vibrate(ApprovedBurst&& burst) {
    const ApprovedBurst consumed = std::move(burst);
    const Instant now = world_->clock().now();
    if (settings_.faults.active(Fault::Unplug, now)) {
        return fail(ErrorCode::Device, "the simulated massager is unplugged");
    }
    if (!(now <= consumed.expires())) {
        return fail(ErrorCode::Device, "the simulated massager refused a burst whose approval expired {:.1f} ms ago",
                    toSeconds(now - consumed.expires()) * 1e3);
    }
    const double t = toSeconds(now);
    start_ = motionAt(t);
    start_s_ = t;
    command_ = consumed.burst().intensity;
    end_s_ = t + consumed.burst().duration.count();
    if (settings_.faults.active(Fault::StuckOn, now)) end_s_ = std::numeric_limits<double>::infinity();
    cut_.store(std::numeric_limits<Instant::rep>::max(), std::memory_order_release);
    if (settings_.faults.active(Fault::Late, now)) {
        return fail(ErrorCode::Timeout, "the simulated massager did not answer within 50 ms");
    }
    return {};
}

void SimulatedMassager::forceOff() noexcept {
    const Instant now = world_->clock().now();
    Instant::rep known = cut_.load(std::memory_order_acquire);
    while (now.count() < known &&
           !cut_.compare_exchange_weak(known, now.count(), std::memory_order_acq_rel, std::memory_order_acquire)) {
    }
}

SimulatedMassager::Motion SimulatedMassager::run(Motion from, double command, double seconds) const noexcept {
    const double tau = settings_.spinUp.count();
    const double offset = from.speed - command;
    const double slope = from.rate + offset / tau;
    const double fade = std::exp(-seconds / tau);
    return {command + (offset + slope * seconds) * fade, (slope - (offset + slope * seconds) / tau) * fade};
}

SimulatedMassager::Motion SimulatedMassager::motionAt(double t_s) const noexcept {
    const double off = std::min(end_s_, toSeconds(Instant(cut_.load(std::memory_order_acquire))));
    if (t_s <= off) return run(start_, command_, t_s - start_s_);
    return run(run(start_, command_, std::max(0.0, off - start_s_)), 0, t_s - std::max(off, start_s_));
}

SimulatedMassager::Vibration SimulatedMassager::vibrationAt(Instant moment) const noexcept {
    const double speed = std::max(0.0, motionAt(toSeconds(moment)).speed);
    return {settings_.topAcceleration_m_s2 * speed * speed, settings_.topFrequency.value() * speed};
}

}  // namespace tacto::sim
