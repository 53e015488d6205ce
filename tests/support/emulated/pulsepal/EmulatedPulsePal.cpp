#include "tests/support/emulated/pulsepal/EmulatedPulsePal.h"

#include <algorithm>

namespace tacto::pulsepal {

namespace {

constexpr std::size_t kHandshakeLength = 2;
constexpr std::size_t kParameterHead = 4;
constexpr std::size_t kTriggerLength = 3;
constexpr std::size_t kContinuousLength = 4;
constexpr std::size_t kNameLength = 8;

}  // namespace

EmulatedPulsePal::EmulatedPulsePal(std::uint32_t firmware) : firmware_(firmware) {}

void EmulatedPulsePal::receive(std::span<const std::uint8_t> bytes, Instant now) {
    advance(now);
    in_.insert(in_.end(), bytes.begin(), bytes.end());
    advance(now);
}

std::size_t EmulatedPulsePal::transmit(std::span<std::uint8_t> into, Instant now) {
    advance(now);
    const std::size_t count = std::min(into.size(), out_.size());
    std::copy_n(out_.begin(), count, into.begin());
    out_.erase(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
}

void EmulatedPulsePal::clickJoystick(Instant now) {
    advance(now);
    frozen_ = false;
    waiting_.reset();
    in_.clear();
    cycle_ = std::max(cycle_, static_cast<std::uint64_t>(now / Instant(50'000)));
    for (int i = 0; i < kChannels; ++i) kill(i);
}

void EmulatedPulsePal::setContinuous(int channel, bool on, Instant now) {
    advance(now);
    auto& output = outputs_.at(static_cast<std::size_t>(channel - 1));
    output.continuous = on;
    output.scheduled = on;
    if (!on) kill(channel - 1);
}

void EmulatedPulsePal::powerCycle(Instant now) {
    advance(now);
    for (int i = 0; i < kChannels; ++i) kill(i);
    outputs_ = {};
    in_.clear();
    out_.clear();
    frozen_ = ready_ = false;
    waiting_.reset();
}

const std::vector<EmittedPhase>& EmulatedPulsePal::phases(Instant now) {
    advance(now);
    return phases_;
}

bool EmulatedPulsePal::active(Instant now) {
    advance(now);
    return std::ranges::any_of(outputs_, [](const Output& output) { return output.playing; });
}

Volts EmulatedPulsePal::level(int channel, Instant now) {
    advance(now);
    return voltsOf(outputs_.at(static_cast<std::size_t>(channel - 1)).code);
}

bool EmulatedPulsePal::frozen(Instant now) {
    advance(now);
    return frozen_;
}

std::size_t EmulatedPulsePal::pending(Instant now) {
    advance(now);
    return in_.size();
}

std::optional<std::uint32_t> EmulatedPulsePal::stored(Parameter parameter, int channel) const {
    if (parameter == Parameter::TriggerMode) return triggerModes_.at(static_cast<std::size_t>(channel - 1));
    if (sizeOf(parameter) == 0) return std::nullopt;
    return of(outputs_.at(static_cast<std::size_t>(channel - 1)), parameter);
}

std::uint32_t EmulatedPulsePal::of(const Output& output, Parameter parameter) const {
    const auto found = output.parameters.find(parameter);
    if (found != output.parameters.end()) return found->second;
    return parameter == Parameter::RestingVoltage ? kZeroVolts : 0;
}

bool EmulatedPulsePal::idle() const noexcept {
    return in_.empty() && std::ranges::none_of(outputs_, [](const Output& output) {
               return output.playing || output.scheduled || output.triggered;
           });
}

void EmulatedPulsePal::advance(Instant now) {
    const auto last = static_cast<std::uint64_t>(now / Instant(50'000));
    while (cycle_ <= last) {
        if (frozen_) break;
        if (waiting_) {
            // The interrupt routine itself waits for the byte: no cycle passes, and no output changes.
            if (handle()) {
                waiting_.reset();
                // The device counts time in cycles, and none has passed: trains continue where they stopped.
                for (auto& output : outputs_) {
                    output.next += last - cycle_;
                    output.end += last - cycle_;
                }
                cycle_ = last;
            } else if (now - *waiting_ >= kReadTimeout) {
                frozen_ = true;
            }
            if (waiting_) break;
        }
        if (idle()) {
            cycle_ = last + 1;
            break;
        }
        cycle();
    }
}

void EmulatedPulsePal::cycle() {
    for (auto& output : outputs_) {
        if (output.scheduled) output.triggered = true;
        output.scheduled = false;
    }
    if (!in_.empty() && !handle()) {
        waiting_ = timeOf(cycle_);
        return;
    }
    for (int i = 0; i < kChannels; ++i) {
        auto& output = outputs_[static_cast<std::size_t>(i)];
        if (!output.playing && output.triggered) start(output);
        if (output.playing) play(i);
    }
    ++cycle_;
}

bool EmulatedPulsePal::handle() {
    if (in_.front() != kStart) {
        in_.pop_front();
        return true;
    }
    if (in_.size() < 2) return false;
    const std::uint8_t code = in_[1];
    std::size_t length = kHandshakeLength;
    if (code == 0x4A) length = kParameterHead;
    if (code == 0x4D) length = kTriggerLength;
    if (code == 0x52) length = kContinuousLength;
    if (code == 0x59) length = kNameLength;
    if (in_.size() < length) return false;
    if (code == 0x4A) length += sizeOf(static_cast<Parameter>(in_[2]));
    if (in_.size() < length) return false;
    ++counts_[code];
    switch (code) {
        case 0x48:
            reply({0x4B, static_cast<std::uint8_t>(firmware_), static_cast<std::uint8_t>(firmware_ >> 8),
                   static_cast<std::uint8_t>(firmware_ >> 16), static_cast<std::uint8_t>(firmware_ >> 24)});
            break;
        case 0x4A:
            setParameter(in_[2], in_[3], kParameterHead);
            reply({kDone});
            break;
        case 0x4D:
            for (std::size_t i = 0; i < kChannels; ++i) outputs_[i].scheduled = (in_[2] >> i & 1) != 0;
            break;
        case 0x50:
        case 0x51:
            for (int i = 0; i < kChannels; ++i) kill(i);
            break;
        case 0x52:
            if (in_[2] >= 1 && in_[2] <= kChannels) {
                auto& output = outputs_[in_[2] - std::size_t{1}];
                output.continuous = output.scheduled = in_[3] != 0;
                if (in_[3] == 0) kill(in_[2] - 1);
            }
            reply({kDone});
            break;
        case 0x59:
            name_.assign(in_.begin() + 2, in_.begin() + kNameLength);
            break;
        default:
            break;
    }
    in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(length));
    return true;
}

void EmulatedPulsePal::setParameter(std::uint8_t number, std::uint8_t channel, std::size_t at) {
    const auto parameter = static_cast<Parameter>(number);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < sizeOf(parameter); ++i) value |= std::uint32_t{in_[at + i]} << (8 * i);
    if (channel < 1 || channel > kChannels || sizeOf(parameter) == 0) return;
    if (parameter == Parameter::TriggerMode) {
        if (channel <= 2) triggerModes_[channel - std::size_t{1}] = static_cast<std::uint8_t>(value);
        return;
    }
    auto& output = outputs_[channel - std::size_t{1}];
    output.parameters[parameter] = value;
    if (parameter == Parameter::RestingVoltage) put(channel - 1, static_cast<std::uint16_t>(value));
}

void EmulatedPulsePal::start(Output& output) {
    output.triggered = false;
    output.playing = true;
    output.stage = Stage::Rest;
    output.next = cycle_ + of(output, Parameter::TrainDelay);
    output.end = output.next + of(output, Parameter::TrainDuration);
}

void EmulatedPulsePal::play(int index) {
    auto& output = outputs_[static_cast<std::size_t>(index)];
    const bool biphasic = of(output, Parameter::Biphasic) != 0;
    const auto code = [&](Parameter parameter) { return static_cast<std::uint16_t>(of(output, parameter)); };
    const auto rest = [&] {
        output.stage = Stage::Rest;
        output.next = cycle_ + of(output, Parameter::InterPulseInterval);
        put(index, code(Parameter::RestingVoltage));
    };
    const auto second = [&] {
        output.stage = Stage::Phase2;
        output.next = cycle_ + of(output, Parameter::Phase2Duration);
        put(index, code(Parameter::Phase2Voltage));
    };
    if (cycle_ == output.next) {
        switch (output.stage) {
            case Stage::Rest:
                output.stage = Stage::Phase1;
                output.next = cycle_ + of(output, Parameter::Phase1Duration);
                put(index, code(Parameter::Phase1Voltage));
                break;
            case Stage::Phase1:
                if (!biphasic) {
                    rest();
                } else if (of(output, Parameter::InterPhaseInterval) == 0) {
                    second();
                } else {
                    output.stage = Stage::Gap;
                    output.next = cycle_ + of(output, Parameter::InterPhaseInterval);
                    put(index, code(Parameter::RestingVoltage));
                }
                break;
            case Stage::Gap:
                second();
                break;
            case Stage::Phase2:
                rest();
                break;
        }
    }
    if (cycle_ == output.end && !output.continuous) kill(index);
}

void EmulatedPulsePal::kill(int index) {
    auto& output = outputs_[static_cast<std::size_t>(index)];
    output.playing = false;
    output.stage = Stage::Rest;
    put(index, static_cast<std::uint16_t>(of(output, Parameter::RestingVoltage)));
}

void EmulatedPulsePal::put(int index, std::uint16_t code) {
    auto& output = outputs_[static_cast<std::size_t>(index)];
    if (code == output.code) return;
    output.code = code;
    if (output.phase) phases_[*output.phase].end = timeOf(cycle_);
    output.phase.reset();
    if (code == of(output, Parameter::RestingVoltage)) return;
    output.phase = phases_.size();
    phases_.push_back({index + 1, timeOf(cycle_), Instant::max(), voltsOf(code)});
}

void EmulatedPulsePal::reply(std::initializer_list<std::uint8_t> bytes) {
    if (ready_) out_.insert(out_.end(), bytes);
}

}  // namespace tacto::pulsepal
