#include "drivers/simulated/SimulatedCircuit.h"

#include <algorithm>
#include <utility>

namespace tacto::sim {

double DrivenPulse::duration_s() const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += steps[i].drive.duration_s;
    return sum;
}

void SimulatedCircuit::fit(const Load& load, Instant now) {
    const std::lock_guard lock(mutex_);
    advance(toSeconds(now));
    load_ = load;
    fitted_s_ = toSeconds(now);
    loadChanged_ = true;
}

Load SimulatedCircuit::load() const {
    const std::lock_guard lock(mutex_);
    return load_;
}

void SimulatedCircuit::setFaults(const FaultSchedule& faults) {
    const std::lock_guard lock(mutex_);
    faults_ = faults;
}

void SimulatedCircuit::play(const DrivenTrain& train, Instant now, Instant allowedUntil) {
    const std::lock_guard lock(mutex_);
    cut(now);
    advance(toSeconds(now));
    cut_.forget();
    allowedUntil_ = toSeconds(allowedUntil);
    train_ = train;
    trainOnset_ = train.onset_s;
    pulse_ = 0;
    advance(toSeconds(now));
}

void SimulatedCircuit::allowUntil(Instant moment, Instant now) {
    const std::lock_guard lock(mutex_);
    advance(toSeconds(now));
    if (train_) allowedUntil_ = toSeconds(moment);
}

bool SimulatedCircuit::active(Instant now) {
    const std::lock_guard lock(mutex_);
    const double t = toSeconds(now);
    advance(t);
    return train_.has_value() || (!pulses_.empty() && t < pulses_.back().end_s);
}

std::uint64_t SimulatedCircuit::trainsBegun(Instant now) {
    const std::lock_guard lock(mutex_);
    advance(toSeconds(now));
    return trains_;
}

std::optional<PulseTotals> SimulatedCircuit::lastPulse(Instant now) {
    const std::lock_guard lock(mutex_);
    const double t = toSeconds(now);
    advance(t);
    for (auto pulse = pulses_.rbegin(); pulse != pulses_.rend(); ++pulse) {
        if (pulse->end_s <= t) return pulse->totals;
    }
    return std::nullopt;
}

double SimulatedCircuit::endOfOutput() const noexcept {
    const auto cut = cut_.at();
    const double cut_s = cut == CutTime::kNever ? kInfinity : toSeconds(cut);
    return std::min(cut_s, allowedUntil_);
}

void SimulatedCircuit::advance(double now_s) {
    const double ends = endOfOutput();
    const double end_s = ends <= now_s ? ends : kInfinity;  // a dead-man time in the future may still move
    if (!pulses_.empty() && !pulses_.back().cut && end_s >= pulses_.back().onset_s && end_s < pulses_.back().end_s) {
        compute(pulses_.back(), end_s);
    }
    while (train_) {
        const double onset = trainOnset_ + pulse_ * train_->period_s;
        if (onset >= end_s) train_.reset();
        if (!train_ || onset > now_s) return;
        if (pulse_ == 0) ++trains_;
        begin(onset, end_s);
        ++pulse_;
        if (pulse_ < train_->pulses || faults_.active(Fault::StuckOn, toInstant(onset))) continue;
        train_.reset();
    }
}

Circuit SimulatedCircuit::circuitAtOnset(double onset_s, const DrivenPulse& pulse, const SourceLimits& limits) const {
    const Instant at = toInstant(onset_s);
    if (faults_.active(Fault::Short, at)) return Circuit{kShortOhms, 0, 0, false};
    std::array<DriveSegment, DrivenPulse::kMaxSteps> segments{};
    for (std::size_t i = 0; i < pulse.count; ++i) segments[i] = pulse.steps[i].drive;
    Circuit circuit = circuitAt(load_, onset_s - fitted_s_, std::span(segments.data(), pulse.count), limits);
    if (faults_.active(Fault::Open, at)) circuit.open = true;
    return circuit;
}

double SimulatedCircuit::residualAt(double t_s) const noexcept {
    if (pulses_.empty() || loadChanged_) return 0;
    DriveSegment rest = last_.pulse.rest;
    rest.duration_s = std::max(0.0, t_s - pulses_.back().end_s);
    return respond(last_.circuit, rest, last_.capacitorVoltage, last_.limits).endCapacitorVoltage;
}

void SimulatedCircuit::begin(double onset_s, double end_s) {
    const double residual = residualAt(onset_s);
    PlayedPulse next;
    if (pulses_.size() >= kKept) {
        next = std::move(pulses_.front());  // reuses the memory of the oldest pulse
        pulses_.pop_front();
    }
    next.number = ++played_;
    next.onset_s = onset_s;
    next.cut = false;
    last_ = {train_->pulse, train_->limits, circuitAtOnset(onset_s, train_->pulse, train_->limits), residual, 0};
    if (const double ohm = last_.circuit.seriesOhm + last_.circuit.parallelOhm;
        train_->sourceOhm > 0 && !last_.circuit.open) {
        for (std::size_t i = 0; i < last_.pulse.count; ++i) {
            auto& drive = last_.pulse.steps[i].drive;
            if (drive.drive != Drive::Voltage) continue;
            drive.start *= ohm / (ohm + train_->sourceOhm);
            drive.end *= ohm / (ohm + train_->sourceOhm);
        }
    }
    loadChanged_ = false;
    pulses_.push_back(std::move(next));
    compute(pulses_.back(), end_s);
}

void SimulatedCircuit::compute(PlayedPulse& into, double end_s) {
    into.pieces.clear();
    PulseResponse response(last_.circuit, last_.limits, last_.startVoltage);
    double elapsed = 0;
    const double longest = end_s - into.onset_s;
    const auto keep = [&](const SegmentResponse& answer, double duration) {
        for (const auto& piece : answer.pieces()) {
            into.pieces.push_back(piece);
            into.pieces.back().start_s += elapsed;
        }
        elapsed += duration;
    };
    for (std::size_t i = 0; i < last_.pulse.count && !into.cut; ++i) {
        auto [drive, part] = last_.pulse.steps[i];
        if (elapsed + drive.duration_s > longest) {
            const double left = std::max(0.0, longest - elapsed);
            drive.end = drive.start + (drive.end - drive.start) * left / drive.duration_s;
            drive.duration_s = left;
            into.cut = true;
        }
        if (drive.duration_s > 0) keep(response.add(drive, part), drive.duration_s);
    }
    into.end_s = into.onset_s + elapsed;
    last_.capacitorVoltage = response.capacitorVoltage();
    DriveSegment tail = last_.pulse.rest;
    tail.duration_s = kTail_s;
    keep(response.add(tail, PulsePart::Rest), kTail_s);
    into.totals = response.totals();
}

}  // namespace tacto::sim
