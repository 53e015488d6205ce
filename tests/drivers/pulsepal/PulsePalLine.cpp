#include "tests/drivers/pulsepal/PulsePalLine.h"

#include <algorithm>
#include <stdexcept>

#include "tests/drivers/conformance/StimulatorConformance.h"

namespace tacto::test {

class PulsePalTransport final : public Transport {
public:
    explicit PulsePalTransport(std::shared_ptr<PulsePalLine> line)
        : line_(std::move(line)), session_(line_->session_) {}

    Result<void> write(std::span<const std::uint8_t> bytes, Seconds /*timeout*/) override {
        std::unique_lock lock(line_->mutex_);
        if (const auto hook = line_->hook_) {
            lock.unlock();
            (*hook)(bytes);
            lock.lock();
        }
        if (!there()) return fail(ErrorCode::Device, "the emulated Pulse Pal is unplugged");
        line_->written_.emplace_back(bytes.begin(), bytes.end());
        if (const auto part = std::exchange(line_->breakOff_, std::nullopt)) {
            line_->device_.receive(bytes.first(std::min(*part, bytes.size())), line_->clock_.now());
            return fail(ErrorCode::Timeout, "the write broke off");
        }
        line_->device_.receive(bytes, line_->clock_.now());
        line_->changed_.notify_all();
        return {};
    }

    Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override {
        std::unique_lock lock(line_->mutex_);
        const Instant deadline = line_->clock_.now() + toInstant(timeout);
        for (;;) {
            if (!there()) return fail(ErrorCode::Device, "the emulated Pulse Pal is unplugged");
            const Instant now = line_->clock_.now();
            if (const auto got = line_->device_.transmit(into, now); got > 0) {
                if (line_->garbled_) std::ranges::fill(into.first(got), *line_->garbled_);
                return got;
            }
            if (now >= deadline) return fail(ErrorCode::Timeout, "nothing came");
            const Instant next = std::min(deadline, now + Instant(std::chrono::microseconds(50)));
            if (line_->movable_ != nullptr) {
                line_->movable_->advanceTo(next);
            } else {
                line_->changed_.wait_for(lock, next - now);
            }
        }
    }

    std::uint64_t dropped() const noexcept override { return 0; }

    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override {
        const std::scoped_lock lock(line_->mutex_);
        if (!there()) return;
        // Like a transfer that is still queued: the same bytes again add nothing.
        const bool queued = line_->device_.pending(line_->clock_.now()) > 0;
        if (queued && !line_->written_.empty() && std::ranges::equal(line_->written_.back(), bytes)) return;
        line_->written_.emplace_back(bytes.begin(), bytes.end());
        line_->device_.receive(bytes, line_->clock_.now());
        line_->changed_.notify_all();
    }

private:
    bool there() const noexcept { return line_->plugged_ && line_->session_ == session_; }
    const std::shared_ptr<PulsePalLine> line_;
    const std::uint64_t session_;
};

PulsePalLine::PulsePalLine(const Clock& clock, VirtualClock* movable, bool ready, std::uint32_t firmware)
    : clock_(clock), movable_(movable), ready_(ready), device_(firmware) {}

Result<std::unique_ptr<Transport>> PulsePalLine::connect() {
    const std::scoped_lock lock(mutex_);
    if (!plugged_) return fail(ErrorCode::NotFound, "no emulated Pulse Pal is plugged in");
    device_.setReady(ready_);
    return std::make_unique<PulsePalTransport>(shared_from_this());
}

Connect PulsePalLine::connector() {
    return [line = shared_from_this()] { return line->connect(); };
}

void PulsePalLine::unplug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = false;
    device_.powerCycle(clock_.now());
    changed_.notify_all();
}

void PulsePalLine::plug() {
    const std::scoped_lock lock(mutex_);
    plugged_ = true;
    ++session_;
}

void PulsePalLine::breakOff(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    breakOff_ = bytes;
}

void PulsePalLine::garble(std::optional<std::uint8_t> byte) {
    const std::scoped_lock lock(mutex_);
    garbled_ = byte;
}

void PulsePalLine::onWrite(std::function<void(std::span<const std::uint8_t>)> hook) {
    const std::scoped_lock lock(mutex_);
    hook_ =
        hook ? std::make_shared<const std::function<void(std::span<const std::uint8_t>)>>(std::move(hook)) : nullptr;
}

std::vector<std::vector<std::uint8_t>> PulsePalLine::written() {
    const std::scoped_lock lock(mutex_);
    return written_;
}

PulsePalBench::PulsePalBench(int channel) : line(std::make_shared<PulsePalLine>(clock, &clock)) {
    auto opened = pulsepal::PulsePalStimulator::open(line->connector(), "pulsepal:S", "S", channel, clock);
    if (!opened) throw std::runtime_error(opened.error().message);
    stimulator = std::move(*opened);
    gate_ = benchGate(clock, stimulator->traits());
}

ApprovedTrain PulsePalBench::approved(const PulseTrain& train) {
    TrainRequest request;
    request.train = train;
    request.interval = std::max(Seconds(2), train.duration());
    request.onset = clock.now();
    auto approval = gate_->approve(request);
    if (!approval) throw std::runtime_error(approval.error().message);
    return std::move(*approval);
}

StimulatorStatus PulsePalBench::status() {
    const auto read = stimulator->status();
    if (!read) throw std::runtime_error(read.error().message);
    return *read;
}

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
