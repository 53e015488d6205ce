#include "drivers/simulated/SimulatedOscilloscope.h"

#include <algorithm>
#include <cmath>

#include "core/base/Random.h"
#include "core/base/Statistics.h"
#include "core/devices/ScopeRange.h"

namespace tacto::sim {

ScopeFlaws drawnFlaws(const ScopeFlaws& otherwise, std::uint64_t seed) {
    Random random(seed, "oscilloscope flaws");
    const auto within = [&random](double halfWidth) { return halfWidth * (2 * random.uniform() - 1); };
    ScopeFlaws out = otherwise;
    const auto& stated = otherwise.stated;
    const double gain = 1 + within(stated.gain);
    out.gain = gain;
    out.currentGain = gain * (1 + within(stated.shunt));
    out.rangeOffset = within(stated.offset);
    out.bow = within(stated.linearity);
    out.timeBase = 1 + within(stated.timeBase);
    out.currentBow = within(stated.linearity);
    return out;
}

SimulatedOscilloscope::SimulatedOscilloscope(DeviceIdentity identity, std::shared_ptr<World> world,
                                             const ScopeTraits& traits, const ScopeFlaws& flaws)
    : identity_(std::move(identity)),
      world_(std::move(world)),
      traits_(traits),
      flaws_(flaws),
      noise_(flaws.seed, "oscilloscope noise") {
    wanted_.sampleRate = std::min(wanted_.sampleRate, traits_.maxRate);
    wanted_.samples = std::min(wanted_.samples, traits_.memoryDepth);
    settings_ = wanted_;
}

Result<void> SimulatedOscilloscope::answers(Instant now) const {
    if (auto there = flaws_.faults.plugged("oscilloscope", now); !there) return there;
    if (flaws_.faults.active(Fault::Garbage, now)) {
        return fail(ErrorCode::Device, "the simulated oscilloscope answered with garbage: not a waveform block");
    }
    if (flaws_.faults.active(Fault::Late, now)) {
        return fail(ErrorCode::Timeout, "the simulated oscilloscope did not answer in time");
    }
    return {};
}

Result<void> SimulatedOscilloscope::configure(const ScopeSettings& settings) {
    if (const auto reply = answers(world_->clock().now()); !reply) return reply;
    if (auto checked = checkScopeRange(settings, traits_); !checked) return checked;
    wanted_ = settings;
    return {};
}

Result<void> SimulatedOscilloscope::arm() {
    const Instant now = world_->clock().now();
    if (const auto reply = answers(now); !reply) return reply;
    settings_ = wanted_;
    trigger_s_.reset();
    forced_s_.reset();
    armed_ = true;
    searchFrom_s_ = armed_s_ = toSeconds(now);
    return {};
}

Result<void> SimulatedOscilloscope::forceTrigger() {
    const Instant now = world_->clock().now();
    if (const auto reply = answers(now); !reply) return reply;
    if (!armed_) {
        return fail(ErrorCode::Unsupported, "the simulated oscilloscope is not armed: it can take no record");
    }
    const double before = settings_.preTrigger * static_cast<double>(settings_.samples) * step_s();
    if (!forced_s_) forced_s_ = std::max(toSeconds(now), searchFrom_s_ + before);
    return {};
}

std::optional<double> SimulatedOscilloscope::findTrigger(const std::deque<PlayedPulse>& pulses) const {
    const auto channel = settings_.triggerOnCurrent ? FilteredTrace::Channel::Current : FilteredTrace::Channel::Voltage;
    const double bandwidth = traits_.bandwidth.value();
    // Searches one pulse at a time, so that a long wait with many pulses takes no longer than up to the next trigger.
    for (std::size_t i = 0; i < pulses.size(); ++i) {
        const double next = i + 1 < pulses.size() ? pulses[i + 1].onset_s : pulses[i].end_s + 1;
        if (next <= searchFrom_s_) continue;
        const double from = std::max(searchFrom_s_, pulses[i].onset_s - 1e-6);
        const FilteredTrace trace(pulses, channel, bandwidth, from, next);
        if (const auto found = trace.risesThrough(settings_.triggerLevel, from); found && *found < next) return found;
    }
    return std::nullopt;
}

Result<std::optional<Capture>> SimulatedOscilloscope::poll() {
    const Instant now = world_->clock().now();
    if (const auto reply = answers(now); !reply) return failure(reply);
    if (!armed_ || flaws_.faults.active(Fault::Stale, now)) return std::optional<Capture>();
    return world_->circuit().inspect(now, [&](const std::deque<PlayedPulse>& pulses) -> std::optional<Capture> {
        const double length = static_cast<double>(settings_.samples) * step_s();
        if (!trigger_s_) trigger_s_ = findTrigger(pulses);
        // The earlier of the two makes the record; a trigger during a record is ignored.
        const bool untriggered = forced_s_ && (!trigger_s_ || *forced_s_ < *trigger_s_);
        const auto middle_s = untriggered ? forced_s_ : trigger_s_;
        if (!middle_s || *middle_s + (1 - settings_.preTrigger) * length > toSeconds(now)) return std::nullopt;
        Capture capture = render(pulses, *middle_s, untriggered);
        searchFrom_s_ = *middle_s + (1 - settings_.preTrigger) * length;
        trigger_s_.reset();
        forced_s_.reset();
        if (flaws_.faults.active(Fault::Nan, now)) {
            for (auto& channel : capture.channels) {
                std::fill(channel.samples.begin(), channel.samples.end(), std::numeric_limits<float>::quiet_NaN());
            }
        }
        return capture;
    });
}

Capture SimulatedOscilloscope::render(const std::deque<PlayedPulse>& pulses, double middle_s, bool untriggered) {
    const double rate = settings_.sampleRate.value();
    const double before = settings_.preTrigger * static_cast<double>(settings_.samples);
    const double stated = stated_s(middle_s);
    Capture capture;
    capture.rate_hz = rate;
    capture.start_s = std::ceil(stated * rate - before) / rate;  // first sample on the grid of the sample clock
    capture.trigger_s = untriggered ? kNaN : stated;
    if (flaws_.stated.states) {
        capture.timeBaseTolerance = flaws_.stated.timeBase;
        capture.stampTolerance_s = 0;  // all records use the same clock
        capture.gainShared = true;
    }
    capture.untriggered = untriggered;
    capture.simulated = true;
    const double start = true_s(capture.start_s);
    const double end = start + static_cast<double>(settings_.samples) * step_s();
    const double bandwidth = traits_.bandwidth.value();
    const auto add = [&](const char* name, const char* unit, double range, FilteredTrace::Channel which, double gain,
                         double offset, double bow) {
        auto& channel = capture.channels.emplace_back();
        channel.name = name;
        channel.unit = unit;
        channel.high = range;
        channel.low = -range;
        channel.lsb = 2 * range / std::pow(2.0, traits_.bits);
        if (flaws_.stated.states) {
            channel.gainTolerance = flaws_.stated.gain;
            channel.offsetTolerance = flaws_.stated.offset * range;
            channel.linearityTolerance = flaws_.stated.linearity * range;
            channel.probeTolerance = *unit == 'A' ? flaws_.stated.shunt : 0;
            channel.statedBy = "the simulated oscilloscope";
        }
        digitise(channel, FilteredTrace(pulses, which, bandwidth, start, end), start, gain, offset, bow);
    };
    add("voltage", "V", settings_.voltageRange.value(), FilteredTrace::Channel::Voltage, flaws_.gain, flaws_.offset,
        flaws_.bow);
    add("current", "A", settings_.currentRange.value() * 1e-3, FilteredTrace::Channel::Current, flaws_.currentGain,
        flaws_.currentOffset, flaws_.currentBow);
    return capture;
}

void SimulatedOscilloscope::digitise(CaptureChannel& channel, const FilteredTrace& trace, double start_s, double gain,
                                     double offset, double channelBow) {
    buffer_.resize(settings_.samples);
    trace.sample(start_s, step_s(), buffer_);
    if (const double reference = channel.unit == "V" ? world_->reference() : 0; reference != 0) {
        for (double& sample : buffer_) sample += reference;
    }
    channel.samples.resize(settings_.samples);
    const double noise = flaws_.noise * channel.high;
    const double perLsb = 1 / channel.lsb;
    const double shift = offset + flaws_.rangeOffset * channel.high;
    // The bow is a cubic through the ends and the middle of the range, scaled to at most 1 before the factor.
    const double bow = 1.5 * std::sqrt(3.0) * channelBow, perRange = 1 / channel.high;
    for (std::size_t k = 0; k < buffer_.size(); ++k) {
        const double x = buffer_[k] * perRange;
        const double bent = buffer_[k] * (1 + (x > -1 && x < 1 ? bow * (1 - x * x) : 0));
        const double seen = gain * bent + shift + noise * noise_.normal();
        const double bounded = std::clamp(seen, channel.low, channel.high);
        const auto code = static_cast<std::int64_t>(bounded * perLsb + (bounded < 0 ? -0.5 : 0.5));
        channel.samples[k] = static_cast<float>(static_cast<double>(code) * channel.lsb);
    }
}

}  // namespace tacto::sim
