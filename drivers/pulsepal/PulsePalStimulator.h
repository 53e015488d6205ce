// PulsePalStimulator.h - one output of a Pulse Pal 2 as a Stimulator: ± 10 V, for bench loads (a voltage source is
// refused for a person).
//
// Each train is programmed completely, with every parameter of its channel, and triggered only after the device has
// acknowledged each parameter: changes made at the joystick have no effect. Trains are finite; continuous mode is never
// used, and the first status() after a train sends an abort, which ends a train left on at the joystick. The device
// does not report its output: only the clock tells whether a train is running. During a train nothing is sent, because
// serial traffic shifts the pulses.
//
// The device has three traps (pulsepal2.md): a command must be one transfer, as half a command freezes the outputs; an
// abort is sent twice, as a trigger just before the first abort survives it; DTR must be set by the opener, or replies
// are lost (UsbBulkOptions::dataTerminalReady).
//
// status() looks again, by identity, for a device that was unplugged or answered wrongly: resetting the fault does just
// this.
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
    static constexpr Seconds kTimeout{0.045};  ///< limit for one exchange; status() has 50 ms
    /// For the questions in open(): longer than the 0.5 s for which the firmware waits for the rest of a command.
    static constexpr Seconds kGreetingTimeout{0.6};

    /// Connects, ends any output of the device, identifies it and turns all four channels off. `uri` opens the device
    /// again, `serial` is its USB serial number. `clock` outlives the device.
    /// Errors: as `connect`; InvalidArgument for a channel that is not 1 to 4; ParseError, Unsupported for another
    /// device; Timeout for one that does not answer; Device.
    [[nodiscard]] static Result<std::unique_ptr<PulsePalStimulator>> open(Connect connect, std::string uri,
                                                                          std::string serial, int channel,
                                                                          const Clock& clock);
    ~PulsePalStimulator() override;  ///< switches the output off
    PulsePalStimulator(const PulsePalStimulator&) = delete;
    PulsePalStimulator& operator=(const PulsePalStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return traits_; }
    /// Refuses what Stimulator and programTrain() refuse, an expired approval, and a train while another is in
    /// progress. A train that forceOff() overtakes is not started, or is cut, which is no error.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    [[nodiscard]] Result<StimulatorStatus> status() override;
    [[nodiscard]] Result<void> keepAlive() override;  ///< no dead-man switch; Device while the device is lost
    void forceOff() noexcept override;

private:
    PulsePalStimulator(Connect connect, Channel channel, const Clock& clock);
    [[nodiscard]] Result<Handshake> reconnect();
    [[nodiscard]] Result<Handshake> greet(Seconds timeout, Seconds quiet);
    [[nodiscard]] Result<void> write(const CommandBytes& command, Instant deadline);
    [[nodiscard]] Result<void> program(std::span<const CommandBytes> commands, Seconds timeout);
    [[nodiscard]] Result<void> readExactly(std::span<std::uint8_t> into, Instant deadline);
    void drain(Seconds quiet);  // discards input until nothing came for `quiet`
    [[nodiscard]] Result<void> ensureSilence();
    [[nodiscard]] Result<void> start(const ApprovedTrain& train, std::uint64_t offs);
    /// Marks the device as lost and returns the error with the device's name.
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

    std::mutex urgent_;  // guards transport_; held only for writeUrgent(), which does not wait, and to replace it
    std::unique_ptr<Transport> transport_;
    std::atomic<std::uint64_t> offs_{0};  // number of forceOff() calls

    // Used only by the session thread:
    bool lost_ = true;
    bool silent_ = false;           // true if aborts were sent since the last train
    std::uint64_t silentOffs_ = 0;  // value of offs_ when the aborts were sent
    std::uint64_t trainOffs_ = 0;   // value of offs_ when the last train began
    Instant trainEnd_{0};
    std::uint64_t trains_ = 0;
};

}  // namespace tacto::pulsepal
