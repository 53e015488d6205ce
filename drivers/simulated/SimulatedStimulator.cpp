#include "drivers/simulated/SimulatedStimulator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/Random.h"
#include "core/devices/Device.h"

namespace tacto::sim {

namespace {
constexpr double kOpenOhms = 300e3;     // higher than any skin or bench load
constexpr double kTouchingOhms = 20;    // lower than any skin or bench load
constexpr double kVoltageFloor = 1e-4;  // V, standard deviation of the read-back
constexpr double kCurrentFloor = 2e-7;  // A, standard deviation of the read-back
constexpr double kImbalanceNoise = 5e-4;
constexpr double kImbalanceUncertainty = 2e-3;
}  // namespace

StimulatorSettings drawnFlaws(const StimulatorSettings& settings) {
    Random random(settings.seed, "stimulator flaws");
    const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
    const StimulatorStatement stated;
    const bool current = settings.traits.drive == Drive::Current;
    StimulatorSettings out = settings;
    out.gain = 1 + within(stated.gain);
    out.offset = within(current ? 1e-3 * stated.offset_ma : stated.offset_v);
    out.coldGain = within(stated.coldGain);
    out.droop = stated.droop * random.uniform();
    out.overshoot = stated.overshoot * random.uniform();
    out.sourceOhm = current ? 0 : stated.sourceOhm * random.uniform();
    out.widthError = Seconds(within(stated.timing.count()));
    out.gapError = Seconds(within(stated.timing.count()));
    return out;
}

SimulatedStimulator::SimulatedStimulator(DeviceIdentity identity, std::shared_ptr<World> world,
                                         const StimulatorSettings& settings)
    : identity_(std::move(identity)),
      world_(std::move(world)),
      settings_(settings),
      timing_(settings.seed, "stimulator timing"),
      meter_(settings.seed, "stimulator read-back"),
      opened_(world_->clock().now()) {
    world_->circuit().setFaults(settings.faults);
}

Result<void> SimulatedStimulator::answers(Instant now) const {
    if (auto there = settings_.faults.plugged("stimulator", now); !there) return there;
    if (settings_.faults.active(Fault::Garbage, now)) {
        return fail(ErrorCode::Device, "the simulated stimulator answered with garbage: the reply fails its checksum");
    }
    if (settings_.faults.active(Fault::Late, now)) {
        return fail(ErrorCode::Timeout, "the simulated stimulator did not answer within 50 ms");
    }
    return {};
}

Result<void> SimulatedStimulator::accepts(const PulseTrain& train) const {
    if (const auto sane = validate(train); !sane) return sane;
    const auto& traits = settings_.traits;
    if (isCurrent(train.amplitude) != (traits.drive == Drive::Current)) {
        return fail(ErrorCode::Device, "the simulated stimulator is a {} source and refused a train in {}",
                    nameOf(traits.drive), amplitudeUnit(train.amplitude));
    }
    const double asked = siValue(train.amplitude) * (traits.drive == Drive::Current ? 1e3 : 1);
    if (!(asked <= traits.amplitudeMax)) {
        return fail(ErrorCode::Device, "the simulated stimulator refused amplitude {}: at most {} {}", asked,
                    traits.amplitudeMax, amplitudeUnit(traits.drive));
    }
    const auto width = train.phaseWidth;
    if (!(width >= traits.widthMin) || !(width <= traits.widthMax)) {
        return fail(ErrorCode::Device, "the simulated stimulator refused phase width {} µs: {} to {} µs", width.count(),
                    traits.widthMin.count(), traits.widthMax.count());
    }
    if (train.pulses > traits.pulsesMax) {
        return fail(ErrorCode::Device, "the simulated stimulator refused {} pulses in a train: at most {}",
                    train.pulses, traits.pulsesMax);
    }
    return {};
}

DrivenPulse SimulatedStimulator::drivenPulse(const PulseTrain& train, Instant now) const {
    const auto& traits = settings_.traits;
    const double unit = traits.drive == Drive::Current ? 1e-3 : 1;
    double magnitude = siValue(train.amplitude);
    if (const double step = traits.amplitudeStep * unit; step > 0) magnitude = std::round(magnitude / step) * step;
    double gain = settings_.gain;
    if (const auto since = settings_.faults.since(Fault::Drift, now)) {
        gain *= 1 + std::min(kMaxDrift, kDriftPerSecond * toSeconds(now - *since));
    }
    gain *= 1 + settings_.coldGain * std::exp(-toSeconds(now - opened_) / kWarmUp.count());
    // At an amplitude of 0 the output stays off, whatever the offset.
    magnitude = magnitude > 0 ? std::max(0.0, gain * magnitude + settings_.offset) : 0;
    const double sign = train.polarity == Polarity::Positive ? 1 : -1;
    const double lead = sign * magnitude;
    const auto phase = [&](Seconds programmed) {
        return std::max(0.0, settings_.widthGain * programmed.count() + settings_.widthError.count());
    };
    const double width = phase(train.phaseWidth);
    const double programmed = Seconds(train.interPhaseGap).count();
    const double gap = programmed > 0 ? std::max(0.0, programmed + settings_.gapError.count()) : 0;
    double second = 0;
    double secondWidth = width;
    if (train.shape == PulseShape::SymmetricBiphasic) second = -lead;
    if (train.shape == PulseShape::AsymmetricBiphasic) {
        second = -lead / train.rechargeRatio;
        secondWidth = phase(train.phaseWidth * train.rechargeRatio);
    }
    second *= 1 - settings_.imbalance;

    const Drive drive = traits.drive;
    const auto off = [&](double duration) {
        return DriveSegment{traits.gap == GapState::HighImpedance ? Drive::HighImpedance : drive, 0, 0, duration};
    };
    const double edge = std::min(settings_.rise.count(), width / 2);
    // A source that holds 0 V drives its falling edges too. A source that opens its output only lets go, half an edge
    // later, so that width at 50 % and charge stay the same.
    const bool drivesDown = traits.gap == GapState::HoldsZero;
    const double hold = drivesDown ? -edge : -edge / 2;
    DrivenPulse pulse;
    // The level overshoots at first and sags from the phase's beginning to its end.
    const double sagged = 1 - settings_.droop;
    const auto plateau = [&](double level, double duration, PulsePart part) {
        const double early = settings_.overshoot > 0 ? std::min(kOvershoot.count(), duration / 4) : 0;
        const double at = 1 - settings_.droop * early / std::max(duration, 1e-12);
        pulse.add({drive, level * (1 + settings_.overshoot), level * at, early}, part);
        pulse.add({drive, level * at, level * sagged, duration - early}, part);
    };
    pulse.rest = off(0);
    pulse.add({drive, 0, lead, edge}, PulsePart::LeadingPhase);
    if (train.shape == PulseShape::Monophasic) {
        plateau(lead, width + hold, PulsePart::LeadingPhase);
        if (drivesDown) pulse.add({drive, lead * sagged, 0, edge}, PulsePart::Rest);
        return pulse;
    }
    if (gap > 0) {
        const double fall = std::min(drivesDown ? edge : edge / 2, gap);
        plateau(lead, width + hold, PulsePart::LeadingPhase);
        if (drivesDown) pulse.add({drive, lead * sagged, 0, fall}, PulsePart::Gap);
        pulse.add(off(gap - fall), PulsePart::Gap);
        pulse.add({drive, 0, second, edge}, PulsePart::SecondPhase);
    } else {
        plateau(lead, width - edge, PulsePart::LeadingPhase);
        pulse.add({drive, lead * sagged, second, edge}, PulsePart::SecondPhase);
    }
    plateau(second, secondWidth + hold, PulsePart::SecondPhase);
    if (drivesDown) pulse.add({drive, second * sagged, 0, edge}, PulsePart::Rest);
    return pulse;
}

Instant SimulatedStimulator::allowedUntil(Instant now) const noexcept {
    const auto deadMan = settings_.traits.deadMan;
    return deadMan.count() > 0 ? now + toInstant(deadMan) : Instant::max();
}

Result<void> SimulatedStimulator::deliver(ApprovedTrain&& consumed) {
    const ApprovedTrain approved = std::move(consumed);
    const auto offs = offs_.load(std::memory_order_acquire);
    const Instant now = world_->clock().now();
    if (settings_.faults.active(Fault::Unplug, now)) return answers(now);
    if (auto current = notExpired(approved.expires(), now, "the simulated stimulator", "a train"); !current)
        return current;
    const auto& train = approved.train();
    if (const auto accepted = accepts(train); !accepted) return accepted;
    if (world_->circuit().active(now)) {
        return fail(ErrorCode::Device, "the simulated stimulator refused a train while another is in progress");
    }
    DrivenTrain driven;
    driven.pulse = drivenPulse(train, now);
    const double late = settings_.faults.active(Fault::Late, now) ? kLateness.count() : 0;
    driven.onset_s =
        toSeconds(now) + late + std::max(0.0, settings_.latency.count() + settings_.jitter.count() * timing_.normal());
    driven.pulses = train.pulses;
    driven.period_s = 1 / train.rate.value();
    driven.sourceOhm = settings_.sourceOhm;
    driven.limits.compliance_V = settings_.traits.compliance.value();
    if (settings_.traits.currentLimit.value() > 0) {
        driven.limits.current_A = settings_.traits.currentLimit.value() * 1e-3;
    }
    world_->circuit().play(driven, now, allowedUntil(now));
    if (offs_.load(std::memory_order_acquire) != offs) world_->circuit().cut(now);
    return answers(now);
}

Result<StimulatorStatus> SimulatedStimulator::status() {
    const Instant now = world_->clock().now();
    if (const auto reply = answers(now); !reply) return failure(reply);
    auto& circuit = world_->circuit();
    StimulatorStatus status;
    status.at = now;
    status.delivering = circuit.active(now);
    status.trainsDelivered = circuit.trainsBegun(now);
    const auto pulse = circuit.lastPulse(now);
    if (!pulse) return status;
    const double relative = settings_.readBackNoise;
    const double volts =
        pulse->leadingEndVoltage_V * (1 + relative * meter_.normal()) + kVoltageFloor * meter_.normal();
    const double amps = pulse->leadingEndCurrent_A * (1 + relative * meter_.normal()) + kCurrentFloor * meter_.normal();
    if (settings_.faults.active(Fault::Nan, now)) {
        status.electrode = ElectrodeState::Ok;
        status.impedance = Ohms(std::numeric_limits<double>::quiet_NaN());
        status.imbalance = status.imbalanceUncertainty = std::numeric_limits<double>::quiet_NaN();
        return status;
    }
    const bool drove = std::abs(volts) > 5 * kVoltageFloor || std::abs(amps) > 5 * kCurrentFloor;
    if (!drove) return status;  // an amplitude of 0 gives no measurement
    status.amplitude = traits().drive == Drive::Current ? 1e3 * std::abs(amps) : std::abs(volts);
    const bool open = std::abs(amps) < 5 * kCurrentFloor || std::abs(volts) > kOpenOhms * std::abs(amps);
    status.electrode = open ? ElectrodeState::Open : ElectrodeState::Ok;
    if (!open) {
        const double ohms = std::abs(volts / amps);
        if (ohms < kTouchingOhms) status.electrode = ElectrodeState::Short;
        status.impedance = Ohms(ohms);
        status.imbalance = std::abs(pulse->imbalance() + kImbalanceNoise * meter_.normal());
        status.imbalanceUncertainty = kImbalanceUncertainty;
    }
    return status;
}

Result<void> SimulatedStimulator::keepAlive() {
    const Instant now = world_->clock().now();
    if (settings_.faults.active(Fault::Unplug, now)) return answers(now);
    world_->circuit().allowUntil(allowedUntil(now), now);
    return answers(now);
}

void SimulatedStimulator::forceOff() noexcept {
    offs_.fetch_add(1, std::memory_order_acq_rel);
    world_->circuit().cut(world_->clock().now());
}

}  // namespace tacto::sim
