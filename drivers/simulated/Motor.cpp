#include "drivers/simulated/Motor.h"

#include <algorithm>
#include <cmath>

namespace tacto::sim {

void Motor::start(Instant at, double command, Instant end) {
    const std::scoped_lock lock(mutex_);
    Motion from;
    if (!commands_.empty()) {
        auto& before = commands_.back();
        before.off = std::min(before.off, cut_.at());
        from = motionIn(before, before.off, at);
    }
    commands_.push_back({from, at, command, end});
    if (commands_.size() > kRemembered) commands_.pop_front();
    cut_.forget();
}

Motor::Motion Motor::run(Motion from, double command, double seconds) const noexcept {
    const double tau = settings_.spinUp.count();
    const double offset = from.speed - command;
    const double slope = from.rate + offset / tau;
    const double fade = std::exp(-seconds / tau);
    return {command + (offset + slope * seconds) * fade, (slope - (offset + slope * seconds) / tau) * fade};
}

Motor::Motion Motor::motionIn(const Command& command, Instant off, Instant moment) const noexcept {
    if (moment <= off) return run(command.from, command.level, toSeconds(moment - command.at));
    const Motion atOff = run(command.from, command.level, std::max(0.0, toSeconds(off - command.at)));
    return run(atOff, 0, toSeconds(moment - std::max(off, command.at)));
}

Motor::Vibration Motor::at(Instant moment) const {
    const std::scoped_lock lock(mutex_);
    const auto after = std::ranges::find_if(commands_, [&](const Command& each) { return each.at > moment; });
    if (after == commands_.begin()) return {};
    const auto& command = *std::prev(after);
    const Instant off = after == commands_.end() ? std::min(command.off, cut_.at()) : command.off;
    const double speed = std::max(0.0, motionIn(command, off, moment).speed);
    return {settings_.topAcceleration_m_s2 * speed * speed, settings_.topFrequency.value() * speed};
}

}  // namespace tacto::sim
