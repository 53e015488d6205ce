#include "drivers/simulated/SimulatedSensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tacto::sim {

namespace {
constexpr double kFaultyDropouts = 0.3;   // share of packets lost during the fault "dropout"
constexpr double kForceDrift_N_s = 0.05;  // newtons per second during the fault "drift"
constexpr double kPressureDrift_Pa_s = 500;
constexpr double kTaxelOffset_Pa = 200;  // largest zero offset of a taxel

double quantised(double value, double step, double limit) noexcept {
    const double bounded = value > limit ? limit : (value < -limit ? -limit : value);
    return static_cast<double>(static_cast<std::int64_t>(bounded / step + (bounded < 0 ? -0.5 : 0.5))) * step;
}
}  // namespace

int SimulatedSensor::ticksPerSample(double rate_hz) noexcept {
    return rate_hz >= 4000 ? 1 : static_cast<int>(std::ceil(4000 / rate_hz));
}

SimulatedSensor::SimulatedSensor(DeviceIdentity identity, std::shared_ptr<World> world, std::shared_ptr<Finger> finger,
                                 const SensorSettings& settings)
    : identity_(std::move(identity)),
      world_(std::move(world)),
      finger_(std::move(finger)),
      settings_(settings),
      ticksPerSample_(ticksPerSample(settings.rate_hz)),
      samplesPerSlow_(std::llround(settings.rate_hz / settings.slowRate_hz)),
      opened_s_(finger_->time_s()),
      lsb_(2 * settings.range_g * kGravity / std::pow(2.0, settings.bits)),
      streams_{{{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, settings.rate_hz,
                 "simulated fingertip accelerometer"},
                {StreamKind::Taxels, settings.taxelsInCounts ? StreamUnit::Count : StreamUnit::Pascal, Finger::kTaxels,
                 settings.slowRate_hz, "simulated taxel array"},
                {StreamKind::Force, StreamUnit::Newton, 1, settings.slowRate_hz, "simulated fingertip force"}}},
      fastNoise_(settings.seed, "accelerometer noise"),
      slowNoise_(settings.seed, "taxel and force noise") {
    FastNoise zero(settings.seed, "taxel offsets");
    for (auto& offset : offsets_) offset = kTaxelOffset_Pa * zero.uniform();
}

bool SimulatedSensor::packetLost(double t_s) const noexcept {
    if (settings_.dropouts <= 0 && settings_.faults.empty()) return false;
    const double share =
        std::max(settings_.dropouts, settings_.faults.active(Fault::Dropout, toInstant(t_s)) ? kFaultyDropouts : 0.0);
    if (share <= 0) return false;
    // A hash of the packet's number decides whether it is lost, so all streams and readers see the same losses.
    auto word = settings_.seed + 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(t_s / kPacket.count() + 1e-6);
    word = (word ^ (word >> 30U)) * 0xBF58476D1CE4E5B9U;
    word = (word ^ (word >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((word ^ (word >> 31U)) >> 11U) * 0x1.0p-53 < share;
}

void SimulatedSensor::noteFaults(Instant now) {
    const auto& faults = settings_.faults;
    silent_ = faults.active(Fault::Stale, now) || faults.active(Fault::Unplug, now);
    stuck_ = faults.active(Fault::Stuck, now);
    nan_ = faults.active(Fault::Nan, now);
    const auto drift = faults.since(Fault::Drift, now);
    drifting_s_ = drift ? toSeconds(now - *drift) : 0;
}

/// Returns the fingertip's acceleration, averaged over the sample.
std::array<double, 3> SimulatedSensor::felt() {
    std::array<double, 3> mean{};
    for (int tick = 0; tick < ticksPerSample_; ++tick) {
        if (sample_ > 0) finger_->step();
        for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += finger_->acceleration()[axis];
        if (sample_ == 0) break;
    }
    const double scale = sample_ == 0 ? 1.0 : 1.0 / ticksPerSample_;
    for (auto& axis : mean) axis *= scale;
    return mean;
}

/// Returns the motor's acceleration in a fixed direction, plus gravity.
std::array<double, 3> SimulatedSensor::shaken() {
    constexpr std::array<double, 3> kDirection{0.6, 0, 0.8};
    std::array<double, 3> out{0, 0, kGravity};
    if (!motor_) return out;
    const double t = opened_s_ + static_cast<double>(sample_) / settings_.rate_hz;
    const auto vibration = motor_->at(toInstant(t));
    motorTurn_ =
        std::fmod(motorTurn_ + 2 * std::numbers::pi * vibration.frequency_hz / settings_.rate_hz, 2 * std::numbers::pi);
    for (std::size_t axis = 0; axis < 3; ++axis)
        out[axis] += kDirection[axis] * vibration.amplitude_m_s2 * std::sin(motorTurn_);
    return out;
}

void SimulatedSensor::sampleFast(SampleBlock& block) {
    const auto acceleration = settings_.onMotor ? shaken() : felt();
    const double noise = settings_.noise_m_s2;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = acceleration[axis] + noise * fastNoise_.normal();
        const double seen = quantised(value, lsb_, settings_.range_g * kGravity);
        if (!stuck_) lastAcceleration_[axis] = seen;
    }
    const double t = opened_s_ + static_cast<double>(sample_) / settings_.rate_hz;
    if (silent_ || packetLost(t)) return;
    block.t_s.push_back(t);
    for (const double a : lastAcceleration_) {
        block.values.push_back(nan_ ? std::numeric_limits<double>::quiet_NaN() : a);
    }
}

void SimulatedSensor::sampleSlow(SampleBlock& taxels, SampleBlock& force) {
    std::array<double, Finger::kTaxels> pressures{};
    finger_->pressures(pressures);
    for (std::size_t i = 0; i < pressures.size(); ++i) {
        const double value = settings_.taxelGain * pressures[i] + offsets_[i] +
                             settings_.taxelNoise_Pa * slowNoise_.normal() + kPressureDrift_Pa_s * drifting_s_;
        const double seen = quantised(value, settings_.taxelStep_Pa, 1e6);
        if (!stuck_) lastPressures_[i] = seen;
    }
    const double value = settings_.forceGain * finger_->force_N() + settings_.forceNoise_N * slowNoise_.normal() +
                         kForceDrift_N_s * drifting_s_;
    if (!stuck_) lastForce_ = quantised(value, settings_.forceStep_N, 50);
    const double t = opened_s_ + static_cast<double>(sample_) / settings_.rate_hz;
    if (silent_ || packetLost(t)) return;
    taxels.t_s.push_back(t);
    for (const double p : lastPressures_) {
        taxels.values.push_back(nan_ ? std::numeric_limits<double>::quiet_NaN() : p);
    }
    force.t_s.push_back(t);
    force.values.push_back(nan_ ? std::numeric_limits<double>::quiet_NaN() : lastForce_);
}

Result<void> SimulatedSensor::read(std::span<SampleBlock> blocks) {
    if (blocks.size() != streams_.size()) {
        return fail(ErrorCode::InvalidArgument, "the simulated finger has {} streams, but {} blocks were given",
                    streams_.size(), blocks.size());
    }
    const Instant now = world_->clock().now();
    const auto& faults = settings_.faults;
    if (settings_.onMotor) motor_ = world_->motor();
    if (auto there = faults.plugged("finger", now); !there) return there;
    const bool late = faults.active(Fault::Late, now);
    const double until = toSeconds(now) - (late ? kLateness.count() : 0);
    const auto due = static_cast<std::int64_t>(std::floor((until - opened_s_) * settings_.rate_hz + 1e-6)) + 1;
    for (; sample_ < due; ++sample_) {
        if (!faults.empty()) {
            noteFaults(toInstant(opened_s_ + static_cast<double>(sample_) / settings_.rate_hz));
        }
        sampleFast(blocks[0]);
        if (sample_ % samplesPerSlow_ == 0) sampleSlow(blocks[1], blocks[2]);
    }
    if (faults.active(Fault::Garbage, now)) {
        return fail(ErrorCode::Device, "the simulated finger answered with garbage: a packet fails its checksum");
    }
    return {};
}

}  // namespace tacto::sim
