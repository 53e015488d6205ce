// PulsePalStimulator.h - a Pulse Pal 2 as a Stimulator: one of its outputs, ± 10 V, for bench loads (a voltage source
// is refused for a person).
//
// Each train is programmed as a whole, every parameter of its channel, and triggered only after the device has
// acknowledged each: what was turned at its joystick meanwhile does not count. Trains are finite; continuous mode is
// never used, and the first status() after a train aborts, so that one left on at the joystick ends there.
// The device reports nothing of its output: that a train runs is known from the clock alone, and while one does the
// wire is left alone, for serial traffic shifts its pulses.
//
// The device has three traps (pulsepal2.md): a command is one transfer, as half of one freezes the outputs; an abort is
// sent twice, as a trigger before the first survives it; DTR must be set, or replies are lost: the opener does that
// (UsbBulkOptions::dataTerminalReady).
//
// A device that was unplugged, or that answered wrongly, is looked for again, by identity, when its status is asked
// for: that is what a reset of the fault does.
//
// Thread-safety: as Stimulator; forceOff() waits for no transfer.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/Clock.h"
#include "core/devices/Stimulator.h"
#include "core/devices/TransportPorts.h"
#include "drivers/pulsepal/TrainProgram.h"

namespace tacto::pulsepal {

class PulsePalStimulator final : public Stimulator {
public:
    static constexpr Seconds kTimeout{0.045};  ///< the longest that one exchange may take; status() has 50 ms
    /// For the questions of open(): longer than the 0.5 s for which the firmware waits for the rest of a command.
    static constexpr Seconds kGreetingTimeout{0.6};

    /// Connects, ends what the device was doing, asks what it is and turns all four channels off. `uri` is what opens
    /// it again, `serial` its USB serial number. `clock` outlives the device.
    /// Errors: as `connect`; InvalidArgument for a channel that is not 1 to 4; ParseError, Unsupported for another
    /// device; Timeout for one that does not answer; Device.
    [[nodiscard]] static Result<std::unique_ptr<PulsePalStimulator>> open(Connect connect, std::string uri,
                                                                          std::string serial, int channel,
                                                                          const Clock& clock);
    ~PulsePalStimulator() override;  ///< output off
    PulsePalStimulator(const PulsePalStimulator&) = delete;
    PulsePalStimulator& operator=(const PulsePalStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return traits_; }
    /// Refuses, besides what Stimulator says, what programTrain() refuses, an expired approval, and a train while
    /// another is in progress. A train that forceOff() overtakes is not begun, or cut, which is not an error.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    [[nodiscard]] Result<StimulatorStatus> status() override;
    [[nodiscard]] Result<void> keepAlive() override;  ///< there is no dead-man; error Device while the device is lost
    void forceOff() noexcept override;

private:
    PulsePalStimulator(Connect connect, Channel channel, const Clock& clock);
    [[nodiscard]] Result<Handshake> reconnect();
    [[nodiscard]] Result<Handshake> greet(Seconds timeout, Seconds quiet);
    [[nodiscard]] Result<void> write(const CommandBytes& command, Instant deadline);
    [[nodiscard]] Result<void> program(std::span<const CommandBytes> commands, Seconds timeout);
    [[nodiscard]] Result<void> readExactly(std::span<std::uint8_t> into, Instant deadline);
    void drain(Seconds quiet);  // throws away what was answered, until nothing came for so long
    [[nodiscard]] Result<void> ensureSilence();
    [[nodiscard]] Result<void> start(const ApprovedTrain& train, std::uint64_t offs);
    /// Notes that the device is lost and passes the error on as the device's.
    [[nodiscard]] tl::unexpected<Error> lost(const Error& error);
    void sendAbort() noexcept;
    [[nodiscard]] bool stoppedSince(std::uint64_t offs) const noexcept {
        return offs_.load(std::memory_order_acquire) != offs;
    }
    [[nodiscard]] bool playing(Instant now) const noexcept { return !stoppedSince(trainOffs_) && now < trainEnd_; }

    const Connect connect_;
    const Channel channel_;
    const Clock& clock_;
    const SourceTraits traits_;
    DeviceIdentity identity_;  // Constant once open() has returned

    std::mutex urgent_;  // the pointer below; held for writeUrgent(), which does not wait, and for replacing it
    std::unique_ptr<Transport> transport_;
    std::atomic<std::uint64_t> offs_{0};  // forceOff() calls

    // The session thread's own:
    bool lost_ = true;
    bool silent_ = false;           // aborts were sent since the last train
    std::uint64_t silentOffs_ = 0;  // offs_ then
    std::uint64_t trainOffs_ = 0;   // offs_ when the last train began
    Instant trainEnd_{0};
    std::uint64_t trains_ = 0;
};

}  // namespace tacto::pulsepal
