// Instrument.h - one open libsigrok device: finds, queries, configures and runs it.
//
// Every call, the sink's calls and the destructor (which closes the device) included, happens on the thread that opened
// the device (SigrokThread).
//
// Thread-safety: only the thread that opened the device.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "drivers/sigrok/protocol/Abilities.h"
#include "drivers/sigrok/protocol/RecordPlan.h"
#include "drivers/sigrok/transport/SigrokLibrary.h"

namespace tacto::sigrok_driver {

class Instrument {
public:
    /// Receives what a session delivers. If one of these calls throws, the session ends and run() returns the error.
    struct Sink {
        /// Takes `samples` in volts of `channel` (index into Abilities::channels); `resolution` in volts, 0: unknown.
        std::function<void(std::size_t channel, std::span<const float> samples, double resolution)> samples;
        std::function<void()> frameBegin;  ///< the device waits for its trigger
        std::function<void()> frameEnd;
        /// Called every 20 ms while the session's loop runs; returning true ends the session.
        std::function<bool()> stop;
    };

    /// Looks for exactly one device. Errors: NotFound; InvalidArgument for an unknown driver or option, or naming the
    /// devices if there are several; Device, Timeout.
    [[nodiscard]] static Result<std::unique_ptr<Instrument>> open(
        std::shared_ptr<SigrokLibrary> library, const std::string& driver,
        const std::vector<std::pair<std::string, std::string>>& options);
    ~Instrument();
    Instrument(const Instrument&) = delete;
    Instrument& operator=(const Instrument&) = delete;

    [[nodiscard]] const Abilities& abilities() const noexcept { return abilities_; }
    /// Sends the settings that stay the same for all records: channels in use, their probes, coupling.
    /// Errors: Device naming the setting that the device did not accept.
    [[nodiscard]] Result<void> prepare(const Wiring& wiring);
    /// Errors: as prepare().
    [[nodiscard]] Result<void> apply(const RecordPlan& plan, const Wiring& wiring);
    /// Returns the sampling rate that the device states, or 0 if it states none.
    [[nodiscard]] double rate() const noexcept;

    /// Runs one session until the device or the sink ends it. `frames` and `samples` limit it if above 0.
    /// Errors: Device with libsigrok's message, also after three complaints of libsigrok without a sample in between.
    [[nodiscard]] Result<void> run(const Sink& sink, std::uint64_t frames, std::uint64_t samples);

private:
    explicit Instrument(std::shared_ptr<SigrokLibrary> library) : library_(std::move(library)) {}
    struct Beat;  // called by the session's loop every 20 ms
    void readAbilities(const std::string& driver);
    void receive(const std::shared_ptr<sigrok::Packet>& packet);
    [[nodiscard]] sigrok::Configurable& settingsOf(std::size_t channel) const;

    const std::shared_ptr<SigrokLibrary> library_;
    std::shared_ptr<sigrok::HardwareDevice> device_;
    std::shared_ptr<sigrok::Session> session_;
    std::vector<std::shared_ptr<sigrok::Channel>> channels_;     ///< the analog channels, as in abilities_
    std::vector<std::shared_ptr<sigrok::ChannelGroup>> groups_;  ///< each channel's group, or null
    Abilities abilities_;
    // Set while run() is running:
    const Sink* sink_ = nullptr;
    std::optional<Error> error_;
    unsigned complaints_ = 0;  ///< value of sigrokLog().errors when the last sample came
    std::vector<float> buffer_;
};

}  // namespace tacto::sigrok_driver
