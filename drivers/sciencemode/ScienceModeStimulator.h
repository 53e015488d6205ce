// ScienceModeStimulator.h - a Hasomed P24 (or RehaMove3) as a Stimulator: a current source of 0 to 130 mA in steps of
// 0.5 mA.
//
// deliver() sends low-level pulses, which end by themselves: the first from the caller's thread, right after the
// approval, the others from the driver's own thread, each after the ack of the pulse before. An electrode that is off,
// shorted or not read, a missing ack or a refusal ends the train. Pulses never follow faster than the approved rate,
// and a train is given up if its next pulse is kMaxLate late (for example after the host slept). Output that the device
// repeats by itself (mid level) is never started here, only ended.
//
// status() looks again, by identity, for a device that was unplugged: resetting the fault does just this.
//
// Thread-safety: as Stimulator; forceOff() waits for no transfer. On a VirtualClock there is no thread, and only the
// owner calls serve().
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/Clock.h"
#include "core/devices/Stimulator.h"
#include "core/devices/TransportPorts.h"
#include "drivers/sciencemode/Exchange.h"
#include "drivers/sciencemode/PulsePlan.h"
#include "drivers/sciencemode/ReadBack.h"

namespace tacto::sciencemode {

struct StimulatorSettings {
    int channel = 0;    ///< 0 to 3
    int connector = 0;  ///< 0 yellow, 1 green
    /// Unverified: whether firmware obeys a fixed level. So the compliance stated to the gate stays 150 V.
    HighVoltage highVoltage = HighVoltage::Default;
    Measurement measurement = Measurement::Voltage;  ///< Voltage gives |Z|, Current gives the amplitude
    /// The operator states in the address that the device is an emulator; its results are then simulated (H4, H9).
    bool emulated = false;
};

/// What a device states about itself.
struct Identification {
    std::string id;
    Version firmware;
    Version protocol;
};
/// Identifies the device. `emulated`: expects an emulator (kEmulatedId). Errors: Device if it is another kind of
/// device, speaks another protocol than version 4 (or 3: RehaMove3), or is not that emulator; Timeout.
[[nodiscard]] Result<Identification> identify(Exchange& exchange, bool emulated = false);

class ScienceModeStimulator final : public Stimulator {
public:
    static constexpr Seconds kMaxLate{0.04};

    /// Connects, identifies the device, ends its output and initialises low level. The identity must be `wanted`,
    /// unless that is empty. `uri` opens the device again. `clock` outlives the device. Errors: as `connect` and
    /// identify(); NotFound if another device answered; Device if it refuses.
    [[nodiscard]] static Result<std::unique_ptr<ScienceModeStimulator>> open(Connect connect, std::string uri,
                                                                             std::string_view wanted,
                                                                             const StimulatorSettings& settings,
                                                                             const Clock& clock);
    ~ScienceModeStimulator() override;  ///< switches the output off
    ScienceModeStimulator(const ScienceModeStimulator&) = delete;
    ScienceModeStimulator& operator=(const ScienceModeStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return traits_; }
    /// Returns with the ack of the first pulse, at most 50 ms after that pulse's end. Refuses what Stimulator and
    /// planPulse() refuse, an expired approval, and a train while another is in progress. A train that forceOff()
    /// overtakes is cut, which is no error; status() reports an electrode that is off.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    /// Returns the last pulse's reading during a train; otherwise asks the device. If a train ended early, the next
    /// status() returns the reason once, as an error. `imbalance` is a lower bound (see ReadBack.h), mostly empty.
    [[nodiscard]] Result<StimulatorStatus> status() override;
    /// Asks the device nothing: this driver sends every pulse itself, so a train ends when the program ends. Errors:
    /// Device if the device is gone.
    [[nodiscard]] Result<void> keepAlive() override;
    void forceOff() noexcept override;

    /// Sends the pulse that is due, if any, and returns when the next pulse is due. For the driver's own thread, and
    /// for tests on a virtual clock.
    Instant serve(Instant now) noexcept;

    [[nodiscard]] ExchangeCounts counts();
    /// Returns the reading of the newest low-level pulse, with its samples; empty before the first pulse. Any thread.
    [[nodiscard]] PulseReading lastReading() const {
        const std::scoped_lock state(state_);
        return reading_;
    }

private:
    /// A train of pulses that is being sent.
    struct Play {
        PulsePlan plan;
        Payload request;
        int pulses = 0;
        int sent = 0;
        Instant period{0};
        Instant asleep{0};  ///< Clock::asleep() at the first pulse
        Instant due{0};     ///< when the next pulse is due; a late pulse delays the later ones
        std::uint64_t offs = 0;
    };
    enum class Sent { Answered, Stopped };  ///< Stopped: forceOff() was called in between

    ScienceModeStimulator(Connect connect, const StimulatorSettings& settings, const Clock& clock);

    // The next functions need io_ held:
    void disconnect();
    [[nodiscard]] Result<Identification> connect();  // identifies the device, and nothing else
    void endEverything();
    /// Sends a request with a plain ack. If a stop came since `offs`, it is sent again after the request.
    [[nodiscard]] Result<void> command(Command command, const Payload& payload, std::uint64_t offs);
    [[nodiscard]] Result<void> ensureLowLevel(std::uint64_t offs);
    [[nodiscard]] Result<void> accepts(const ApprovedTrain& train);
    [[nodiscard]] Result<Sent> firePulse(const PulsePlan& plan, const Payload& request, std::uint64_t offs,
                                         PulseReading& reading, Instant& written);
    [[nodiscard]] Result<StimulatorStatus> askStatus();

    static constexpr std::uint64_t kNotInitialised = ~std::uint64_t{0};
    [[nodiscard]] bool stoppedSince(std::uint64_t offs) const noexcept {
        return offs_.load(std::memory_order_acquire) != offs;
    }
    [[nodiscard]] bool playing() const noexcept;                // needs state_ held
    [[nodiscard]] StimulatorStatus snapshot(Instant at) const;  // needs state_ held
    void firePlayed(Instant now);
    void sendStop() noexcept;
    void run();

    const Connect connect_;
    const StimulatorSettings settings_;
    const Clock& clock_;
    const SourceTraits traits_;
    DeviceIdentity identity_;  // Constant once open() has returned

    std::mutex io_;  // the transport's only caller; held for an exchange. Locked before the others
    std::unique_ptr<Exchange> exchange_;
    std::uint64_t lowLevelOffs_ = kNotInitialised;  // offs_ when low level was initialised; a later stop ends it
    std::atomic<bool> gone_{false};

    std::mutex urgent_;  // guards transport_; held only for writeUrgent(), which does not wait, and to replace it
    std::unique_ptr<Transport> transport_;

    std::atomic<std::uint64_t> offs_{0};  // number of forceOff() calls

    mutable std::mutex state_;  // guards everything below; held only for copies
    std::optional<Play> play_;
    PulseReading reading_;
    std::optional<Error> ended_;  // why the last train ended early
    std::uint64_t trains_ = 0;
    std::condition_variable changed_;
    bool quitting_ = false;

    std::thread thread_;  // declared last: starts when everything else is ready
};

}  // namespace tacto::sciencemode
