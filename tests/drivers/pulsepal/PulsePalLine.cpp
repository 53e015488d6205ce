#include "tests/drivers/pulsepal/PulsePalLine.h"

#include <algorithm>

#include "tests/support/BenchGate.h"
#include "tests/support/Refused.h"

namespace tacto::test {

PulsePalLine::PulsePalLine(const Clock& clock, VirtualClock* movable, bool ready, std::uint32_t firmware)
    : DeviceLine(clock, movable, "Pulse Pal"), ready_(ready), device_(firmware) {}

void PulsePalLine::breakOff(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    breakOff_ = bytes;
}

void PulsePalLine::garble(std::optional<std::uint8_t> byte) {
    const std::scoped_lock lock(mutex_);
    garbled_ = byte;
}

Result<void> PulsePalLine::receive(std::span<const std::uint8_t> bytes, Instant now) {
    if (const auto part = std::exchange(breakOff_, std::nullopt)) {
        device_.receive(bytes.first(std::min(*part, bytes.size())), now);
        return fail(ErrorCode::Timeout, "the write broke off");
    }
    device_.receive(bytes, now);
    return {};
}

void PulsePalLine::receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept {
    // Acts like a transfer that is still queued: the same bytes again add nothing.
    const bool queued = device_.pending(now) > 0;
    if (queued && !written_.empty() && std::ranges::equal(written_.back(), bytes)) return;
    keepWritten(bytes);
    device_.receive(bytes, now);
}

std::size_t PulsePalLine::transmit(std::span<std::uint8_t> into, Instant now) {
    const auto got = device_.transmit(into, now);
    if (garbled_) std::ranges::fill(into.first(got), *garbled_);
    return got;
}

/// Returns the time of the device's next cycle.
std::optional<Instant> PulsePalLine::nextTransmit(Instant now) { return now + Instant(std::chrono::microseconds(50)); }

PulsePalBench::PulsePalBench(int channel) : line(std::make_shared<PulsePalLine>(clock, &clock)) {
    stimulator = accepted(pulsepal::PulsePalStimulator::open(line->connector(), "pulsepal:S", "S", channel, clock));
    gate_ = benchGate(clock, stimulator->traits());
}

ApprovedTrain PulsePalBench::approved(const PulseTrain& train) { return approve(*gate_, clock, train); }

StimulatorStatus PulsePalBench::status() { return accepted(stimulator->status()); }

PulseTrain pulseTrain(double volts, int pulses, double rate_hz) {
    PulseTrain train;
    train.amplitude = Volts(volts);
    train.pulses = pulses;
    train.rate = Hertz(rate_hz);
    return train;
}

std::vector<TransportPort> PulsePalPorts::list() const {
    std::vector<TransportPort> all;
    for (const auto& [port, line] : plugged) all.push_back(port);
    return all;
}

Result<std::unique_ptr<Transport>> PulsePalPorts::open(const TransportPort& port) {
    for (const auto& [other, line] : plugged) {
        if (other.place == port.place) return line->connect();
    }
    return fail(ErrorCode::NotFound, "nothing in {}", port.place);
}

}  // namespace tacto::test
