// PulsePalLine.h - an emulated Pulse Pal at the other end of a Transport, in this process.
//
// On a virtual clock a read that waits moves the clock, so it must be the clock's only mover meanwhile. The line
// outlives its transports: what was put out can be judged after the driver has closed.
//
// Thread-safety: every function from any thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "core/base/Clock.h"
#include "core/devices/TransportPorts.h"
#include "drivers/pulsepal/PulsePalStimulator.h"
#include "tests/support/emulated/pulsepal/EmulatedPulsePal.h"

namespace tacto::test {

class PulsePalLine : public std::enable_shared_from_this<PulsePalLine> {
public:
    /// `movable` is `clock` itself where it is virtual, else null. `ready`: whether transports set DTR.
    PulsePalLine(const Clock& clock, VirtualClock* movable, bool ready = true, std::uint32_t firmware = 21);

    /// Errors: NotFound while unplugged.
    [[nodiscard]] Result<std::unique_ptr<Transport>> connect();
    [[nodiscard]] Connect connector();

    void unplug();
    void plug();
    /// The next write breaks off after so many bytes and reports a time-out.
    void breakOff(std::size_t bytes);
    /// Its answers are this byte from now on, as many as it would send; nothing: its own.
    void garble(std::optional<std::uint8_t> byte);
    /// Called in every write(), before its bytes reach the device.
    void onWrite(std::function<void(std::span<const std::uint8_t>)> hook);
    /// Bytes of every write() and writeUrgent() so far, one entry a transfer.
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> written();

    /// Calls `look(device, now)` while nothing else does.
    template <class Look>
    auto inspect(Look&& look) {
        const std::scoped_lock lock(mutex_);
        return look(device_, clock_.now());
    }
    [[nodiscard]] bool active() {
        return inspect([](auto& device, Instant now) { return device.active(now); });
    }
    [[nodiscard]] std::vector<pulsepal::EmittedPhase> phases() {
        return inspect([](auto& device, Instant now) { return device.phases(now); });
    }

private:
    friend class PulsePalTransport;
    const Clock& clock_;
    VirtualClock* const movable_;
    const bool ready_;
    std::mutex mutex_;
    std::condition_variable changed_;
    pulsepal::EmulatedPulsePal device_;
    bool plugged_ = true;
    std::uint64_t session_ = 0;  // plug() makes old transports useless
    std::optional<std::size_t> breakOff_;
    std::optional<std::uint8_t> garbled_;
    std::shared_ptr<const std::function<void(std::span<const std::uint8_t>)>> hook_;
    std::vector<std::vector<std::uint8_t>> written_;
};

/// A driver on such a line, with a gate that approves for it, on the virtual clock.
class PulsePalBench {
public:
    explicit PulsePalBench(int channel = 1);
    /// Lets time pass.
    void wait(Seconds duration) { clock.advanceTo(clock.now() + toInstant(duration)); }
    [[nodiscard]] ApprovedTrain approved(const PulseTrain& train);
    [[nodiscard]] Result<void> deliver(const PulseTrain& train) { return stimulator->deliver(approved(train)); }
    /// The status, which must be there.
    [[nodiscard]] StimulatorStatus status();

    VirtualClock clock;
    std::shared_ptr<PulsePalLine> line;
    std::unique_ptr<pulsepal::PulsePalStimulator> stimulator;

private:
    std::unique_ptr<SafetyGate> gate_;
};

/// 200 µs a phase, 100 µs between, symmetric.
[[nodiscard]] PulseTrain pulseTrain(double volts, int pulses = 1, double rate_hz = 100);

/// Ports that lead to lines.
class PulsePalPorts final : public TransportPorts {
public:
    std::vector<std::pair<TransportPort, std::shared_ptr<PulsePalLine>>> plugged;
    std::vector<TransportPort> list() const override;
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override;
};

}  // namespace tacto::test
