// Instrument.h - one open libsigrok device: found by its driver, queried, configured and run.
//
// All of it, the sink's calls included, happens on the thread that opened it (SigrokThread); so does the destructor,
// which closes the device.
//
// Thread-safety: the thread that opened it.
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
    /// Takes what a session gives. An exception from either ends the session and comes back as run()'s error.
    struct Sink {
        /// `samples` of channel `channel` (index into Abilities::channels), in V; the resolution in V, 0 unknown.
        std::function<void(std::size_t channel, std::span<const float> samples, double resolution)> samples;
        std::function<void()> frameBegin;  ///< the device waits for its trigger
        std::function<void()> frameEnd;
        /// Asked every 20 ms while the session's loop turns; true ends the session.
        std::function<bool()> stop;
    };

    /// Looks for exactly one device. Errors: NotFound; InvalidArgument for an unknown driver or option, or when several
    /// are found, naming them; Device, Timeout.
    [[nodiscard]] static Result<std::unique_ptr<Instrument>> open(
        std::shared_ptr<SigrokLibrary> library, const std::string& driver,
        const std::vector<std::pair<std::string, std::string>>& options);
    ~Instrument();
    Instrument(const Instrument&) = delete;
    Instrument& operator=(const Instrument&) = delete;

    [[nodiscard]] const Abilities& abilities() const noexcept { return abilities_; }
    /// Tells the device what does not change from record to record: which channels, their probes, coupling.
    /// Errors: Device naming the setting it did not take.
    [[nodiscard]] Result<void> prepare(const Wiring& wiring);
    /// Errors: as prepare().
    [[nodiscard]] Result<void> apply(const RecordPlan& plan, const Wiring& wiring);
    /// The sampling rate as the device says it, 0 when it does not.
    [[nodiscard]] double rate() const noexcept;

    /// One session, until the device or the sink ends it. `frames` and `samples` limit it where above 0.
    /// Errors: Device with what libsigrok says, also when it has complained three times without a sample between.
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
    std::vector<std::shared_ptr<sigrok::Channel>> channels_;     ///< the analog ones, as in abilities_
    std::vector<std::shared_ptr<sigrok::ChannelGroup>> groups_;  ///< each channel's group, or null
    Abilities abilities_;
    // Set while run() runs:
    const Sink* sink_ = nullptr;
    std::optional<Error> error_;
    unsigned complaints_ = 0;  ///< sigrokLog().errors when the last sample came
    std::vector<float> buffer_;
};

}  // namespace tacto::sigrok_driver
