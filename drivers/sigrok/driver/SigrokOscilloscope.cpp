#include "drivers/sigrok/driver/SigrokOscilloscope.h"

#include "core/devices/Oscilloscope.h"
#include "drivers/sigrok/driver/Acquisition.h"
#include "drivers/sigrok/transport/SigrokThread.h"
#include "drivers/sigrok/transport/TcpRelay.h"

namespace tacto::sigrok_driver {

namespace {

// libsigrok's rigol-ds driver waits up to 3 s for a trigger and asks all that time; its longest pause is 1 s.
constexpr Seconds kLoopTimeout(5);
constexpr Seconds kSilence(3);
constexpr Seconds kLoopTimeoutUnseen(10);  // used without a relay: a long read then looks like silence
constexpr Seconds kOpenTimeout(9);
constexpr Seconds kArmTimeout(6);  // an earlier wait for a trigger may last 3 s more

class SigrokOscilloscope : public Oscilloscope {
public:
    SigrokOscilloscope(std::unique_ptr<TcpRelay> relay, std::unique_ptr<SigrokThread> thread,
                       std::shared_ptr<Acquisition> acquisition, DeviceIdentity identity)
        : relay_(std::move(relay)),
          thread_(std::move(thread)),
          acquisition_(std::move(acquisition)),
          identity_(std::move(identity)),
          traits_(traitsOf(acquisition_->abilities, acquisition_->wiring)) {}

    ~SigrokOscilloscope() override {
        acquisition_->queue.disarm();
        acquisition_->closing = true;
        thread_->post([acquisition = acquisition_] { acquisition->instrument.reset(); });
        if (!thread_->idle(Seconds(0.6)) && relay_) relay_->cut();
        thread_.reset();  // waits at most 0.8 s
    }

    const DeviceIdentity& identity() const noexcept override { return identity_; }
    const ScopeTraits& traits() const noexcept override { return traits_; }

    Result<void> configure(const ScopeSettings& settings) override {
        auto plan = planRecord(settings, acquisition_->abilities, acquisition_->wiring);
        if (!plan) return failure(plan);
        plan_ = std::move(*plan);
        return {};
    }

    Result<void> arm() override {
        if (const auto well = check(); !well) return well;
        if (!plan_) {
            if (const auto configured = configure(usual()); !configured) return configured;
        }
        const auto number = acquisition_->queue.arm();
        thread_->post([acquisition = acquisition_, plan = *plan_, number] { acquisition->acquire(plan, number); });
        // Waits, because a pulse that comes before the instrument is ready would be missed unnoticed.
        if (acquisition_->queue.waitStarted(number, kArmTimeout)) return {};
        if (const auto well = check(); !well) return well;
        acquisition_->queue.fail({ErrorCode::Timeout, fmt::format("{} has not begun to wait for a trigger for {:.0f} s",
                                                                  identity_.name, kArmTimeout.count())});
        return check();
    }

    void disarm() noexcept override { acquisition_->queue.disarm(); }

    Result<std::optional<Capture>> poll() override {
        if (auto capture = acquisition_->queue.pop()) {
            capture->simulated = identity_.simulated;
            return capture;
        }
        if (const auto well = check(); !well) return failure(well);
        return std::optional<Capture>{};
    }

protected:
    Acquisition& acquisition() { return *acquisition_; }

    Result<void> check() {
        auto& queue = acquisition_->queue;
        if (relay_) {
            if (const auto fault = relay_->fault()) queue.fail(*fault);
        }
        const bool silent = !relay_ || relay_->silence() > kSilence;
        const Seconds timeout = relay_ ? kLoopTimeout : kLoopTimeoutUnseen;
        if (queue.armed() && silent && queue.sinceTurn() > timeout) {
            queue.fail({ErrorCode::Timeout, fmt::format("{} has said nothing for {:.0f} s in the middle of a record",
                                                        identity_.name, queue.sinceTurn().count())});
            if (relay_) relay_->cut();
        }
        if (const auto error = queue.error()) return tl::unexpected<Error>(*error);
        return {};
    }

private:
    ScopeSettings usual() const {
        ScopeSettings settings;
        settings.sampleRate = std::min(settings.sampleRate, traits_.maxRate);
        settings.samples = std::min(settings.samples, traits_.memoryDepth);
        return settings;
    }

    const std::unique_ptr<TcpRelay> relay_;  // null if the connection is not plain TCP
    std::unique_ptr<SigrokThread> thread_;
    const std::shared_ptr<Acquisition> acquisition_;
    const DeviceIdentity identity_;
    const ScopeTraits traits_;
    std::optional<RecordPlan> plan_;
};

/// A streaming device can take a record at any time. Other instruments wait for their own trigger, which libsigrok
/// cannot force.
class StreamingOscilloscope final : public SigrokOscilloscope, public ForcedTrigger {
public:
    using SigrokOscilloscope::SigrokOscilloscope;
    Result<void> forceTrigger() override {
        if (const auto well = check(); !well) return well;
        if (!acquisition().queue.armed()) {
            return fail(ErrorCode::Unsupported, "{} is not armed: it can take no record", identity().name);
        }
        acquisition().queue.force();
        return {};
    }
};

DeviceIdentity identityOf(const Abilities& abilities, const std::string& uri) {
    DeviceIdentity identity{uri, Role::Oscilloscope, abilities.vendor, abilities.serial, abilities.firmware};
    if (!abilities.model.empty()) identity.name += (identity.name.empty() ? "" : " ") + abilities.model;
    identity.simulated = abilities.driver == "demo";
    return identity;
}

}  // namespace

Result<std::unique_ptr<Oscilloscope>> openOscilloscope(const ScopeUri& uri, const std::string& itself,
                                                       const Clock& clock) {
    std::unique_ptr<TcpRelay> relay;
    auto options = uri.options;
    if (const auto tcp = uri.tcp()) {
        auto started = TcpRelay::start(tcp->first, tcp->second);
        if (!started) return failure(started);
        relay = std::move(*started);
        options = uri.optionsVia("127.0.0.1", relay->port());
    }
    auto thread = std::make_unique<SigrokThread>();
    const auto acquisition = std::make_shared<Acquisition>(clock);
    auto opened =
        thread->run([acquisition, uri, options]() -> Result<void> { return acquisition->open(uri, options); },
                    kOpenTimeout, fmt::format("libsigrok's {} driver looking for the instrument", uri.driver));
    if (!opened) {
        acquisition->closing = true;
        const auto fault = relay ? relay->fault() : std::nullopt;
        if (relay) relay->cut();
        return fault ? tl::unexpected<Error>(*fault) : failure(opened);
    }
    auto identity = identityOf(acquisition->abilities, itself);
    if (acquisition->abilities.streams()) {
        return std::make_unique<StreamingOscilloscope>(std::move(relay), std::move(thread), acquisition,
                                                       std::move(identity));
    }
    return std::make_unique<SigrokOscilloscope>(std::move(relay), std::move(thread), acquisition, std::move(identity));
}

}  // namespace tacto::sigrok_driver
