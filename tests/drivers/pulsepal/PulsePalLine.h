// PulsePalLine.h - connects an emulated Pulse Pal, which loses its power when unplugged, to a Transport in this process
// (see DeviceLine). Also a driver on such a line.
//
// Thread-safety: any thread may call the line's functions.
#pragma once

#include <memory>
#include <optional>

#include "drivers/pulsepal/PulsePalStimulator.h"
#include "tests/support/emulated/DeviceLine.h"
#include "tests/support/emulated/pulsepal/EmulatedPulsePal.h"

namespace tacto::test {

class PulsePalLine final : public DeviceLine {
public:
    /// `ready`: true if transports set DTR.
    PulsePalLine(const Clock& clock, VirtualClock* movable, bool ready = true, std::uint32_t firmware = 21);

    /// Makes the next write stop after this many bytes and report a timeout.
    void breakOff(std::size_t bytes);
    /// From now on, replaces each byte of the answers by `byte`; nothing: restores the real answers.
    void garble(std::optional<std::uint8_t> byte);

    template <class Look>
    auto inspect(Look&& look) {
        return lookAt(device_, std::forward<Look>(look));
    }
    [[nodiscard]] bool active() {
        return inspect([](auto& device, Instant now) { return device.active(now); });
    }
    [[nodiscard]] std::vector<pulsepal::EmittedPhase> phases() {
        return inspect([](auto& device, Instant now) { return device.phases(now); });
    }

private:
    [[nodiscard]] Result<void> receive(std::span<const std::uint8_t> bytes, Instant now) override;
    void receiveUrgent(std::span<const std::uint8_t> bytes, Instant now) noexcept override;
    [[nodiscard]] std::size_t transmit(std::span<std::uint8_t> into, Instant now) override;
    [[nodiscard]] std::optional<Instant> nextTransmit(Instant now) override;
    void connected() override { device_.setReady(ready_); }
    void powerCycle(Instant now) override { device_.powerCycle(now); }

    const bool ready_;
    pulsepal::EmulatedPulsePal device_;
    std::optional<std::size_t> breakOff_;
    std::optional<std::uint8_t> garbled_;
};

/// A driver on such a line, with a gate that approves trains, on the virtual clock.
class PulsePalBench {
public:
    explicit PulsePalBench(int channel = 1);
    /// Lets time pass.
    void wait(Seconds duration) { clock.advanceTo(clock.now() + toInstant(duration)); }
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train);
    [[nodiscard]] Result<void> deliver(const PulseTrain& train) { return stimulator->deliver(approved(train)); }
    /// Returns the status; if there is none, the test fails.
    [[nodiscard]] StimulatorStatus status();

    VirtualClock clock;
    std::shared_ptr<PulsePalLine> line;
    std::unique_ptr<pulsepal::PulsePalStimulator> stimulator;

private:
    std::unique_ptr<SafetyGate> gate_;
};

/// A symmetric train with 200 µs a phase and a gap of 100 µs.
[[nodiscard]] PulseTrain pulseTrain(double volts, int pulses = 1, double rate_hz = 100);

/// Ports that open these lines.
class PulsePalPorts final : public TransportPorts {
public:
    std::vector<std::pair<TransportPort, std::shared_ptr<PulsePalLine>>> plugged;
    std::vector<TransportPort> list() const override;
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override;
};

}  // namespace tacto::test
