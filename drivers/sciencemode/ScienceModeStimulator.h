// ScienceModeStimulator.h - a Hasomed P24 (or RehaMove3) as a Stimulator: a current source of 0 to 130 mA in steps of
// 0.5 mA.
//
// deliver() sends low-level pulses, which end by themselves: the first from the caller's thread, so that nothing lies
// between approval and wire, the others timed by the driver's own thread, each after the ack of the one before. An
// electrode that is found off, shorted or not read, an ack that is missing or a refusal ends the train there. Pulses
// never follow each other faster than the approved rate, and a train whose next pulse is kMaxLate late (a host that
// slept) is given up. What repeats by itself in the device (mid level) is never begun here, only ended.
//
// A device that was unplugged is looked for again, by identity, when its status is asked for: that is what a reset of
// the fault does.
//
// Thread-safety: as Stimulator; forceOff() waits for no transfer. On a VirtualClock there is no thread and the owner
// calls serve(); it is called nowhere else.
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
    /// It is not verified whether firmware honours a fixed level, so the compliance stated to the gate stays 150 V.
    HighVoltage highVoltage = HighVoltage::Default;
    Measurement measurement = Measurement::Voltage;  ///< Voltage gives |Z|, Current the amplitude
    /// The operator's word, in the address: what answers is an emulator, and what it gives is simulated (H4, H9).
    bool emulated = false;
};

/// A device's words about itself.
struct Identification {
    std::string id;
    Version firmware;
    Version protocol;
};
/// `emulated`: whether an emulator is expected, whose identity begins with kEmulatedId. Errors: Device when it is none
/// of this kind, speaks another protocol than version 4 (or 3: RehaMove3), or is another than that emulator; Timeout.
[[nodiscard]] Result<Identification> identify(Exchange& exchange, bool emulated = false);

class ScienceModeStimulator final : public Stimulator {
public:
    static constexpr Seconds kMaxLate{0.04};

    /// Connects, asks the device who it is, ends whatever it was doing and initialises low level. `wanted`, unless
    /// empty, is the identity that it must have. `uri` is what opens it again. `clock` outlives the device.
    /// Errors: as `connect` and identify(); NotFound when another device answered; Device when it refuses.
    [[nodiscard]] static Result<std::unique_ptr<ScienceModeStimulator>> open(Connect connect, std::string uri,
                                                                             std::string_view wanted,
                                                                             const StimulatorSettings& settings,
                                                                             const Clock& clock);
    ~ScienceModeStimulator() override;  ///< output off
    ScienceModeStimulator(const ScienceModeStimulator&) = delete;
    ScienceModeStimulator& operator=(const ScienceModeStimulator&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const SourceTraits& traits() const noexcept override { return traits_; }
    /// Returns with the ack of the first pulse: 50 ms at most after the pulse's own end. Refuses, besides what
    /// Stimulator says, what planPulse() refuses, an expired approval, and a train while another is in progress. A
    /// train that forceOff() overtakes is cut, which is not an error; status() reports an electrode that is off.
    [[nodiscard]] Result<void> deliver(ApprovedTrain&& train) override;
    /// During a train, what its last pulse said; otherwise the device is asked. What ended a train early is the error
    /// of the status() after it, once. `imbalance` is a lower bound (see ReadBack.h) and mostly absent.
    [[nodiscard]] Result<StimulatorStatus> status() override;
    /// Asks the device nothing: this driver sends every pulse itself, so a train ends with the program. Errors: Device
    /// when the device is gone.
    [[nodiscard]] Result<void> keepAlive() override;
    void forceOff() noexcept override;

    /// Sends the pulse that is due, if any, and returns when the next one is. For the driver's own thread, and for
    /// tests on a virtual clock.
    Instant serve(Instant now) noexcept;

    [[nodiscard]] ExchangeCounts counts();
    /// The report of the newest low-level pulse, including its samples; nothing measured before the first. Any thread.
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
        Instant due{0};     ///< when the next is due; a pulse that slipped moves those after it
        std::uint64_t offs = 0;
    };
    enum class Sent { Answered, Stopped };  ///< Stopped: forceOff() came between

    ScienceModeStimulator(Connect connect, const StimulatorSettings& settings, const Clock& clock);

    // These need io_ held:
    void disconnect();
    [[nodiscard]] Result<Identification> connect();  // asks who is there, and nothing else
    void endEverything();
    /// A request with a plain ack. A stop since `offs` is repeated behind it.
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

    std::mutex io_;  // the transport's one caller; held for an exchange. Locked before the others
    std::unique_ptr<Exchange> exchange_;
    std::uint64_t lowLevelOffs_ = kNotInitialised;  // offs_ when low level was initialised: any later stop ended it
    std::atomic<bool> gone_{false};

    std::mutex urgent_;  // the pointer below; held for writeUrgent(), which does not wait, and for replacing it
    std::unique_ptr<Transport> transport_;

    std::atomic<std::uint64_t> offs_{0};  // forceOff() calls

    mutable std::mutex state_;  // guards all below; held for copies only
    std::optional<Play> play_;
    PulseReading reading_;
    std::optional<Error> ended_;  // why the last train ended early
    std::uint64_t trains_ = 0;
    std::condition_variable changed_;
    bool quitting_ = false;

    std::thread thread_;  // Last: starts when all else is ready
};

}  // namespace tacto::sciencemode
