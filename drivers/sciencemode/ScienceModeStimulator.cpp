#include "drivers/sciencemode/ScienceModeStimulator.h"

#include <utility>

namespace tacto::sciencemode {

ScienceModeStimulator::ScienceModeStimulator(Connect connect, const StimulatorSettings& settings, const Clock& clock)
    : connect_(std::move(connect)),
      settings_(settings),
      clock_(clock),
      traits_(sourceTraits(settings.measurement == Measurement::Voltage)) {
    static_cast<void>(stopFrames());  // encoded now, so that forceOff() finds them ready
}

Result<std::unique_ptr<ScienceModeStimulator>> ScienceModeStimulator::open(Connect connect, std::string uri,
                                                                           std::string_view wanted,
                                                                           const StimulatorSettings& settings,
                                                                           const Clock& clock) {
    std::unique_ptr<ScienceModeStimulator> opened(new ScienceModeStimulator(std::move(connect), settings, clock));
    auto& self = *opened;
    {
        const std::scoped_lock io(self.io_);
        const auto found = self.connect();
        if (!found) return failure(found);
        if (!wanted.empty() && found->id != wanted) {
            self.disconnect();
            return fail(ErrorCode::NotFound, "stimulator {} answered where {} was asked for", found->id, wanted);
        }
        self.identity_ = {std::move(uri),
                          Role::Stimulator,
                          "ScienceMode stimulator",
                          found->id,
                          fmt::format("{}, ScienceMode {}", found->firmware.text(), found->protocol.text()),
                          found->id.starts_with(kEmulatedId)};
        self.endEverything();
        if (const auto ready = self.ensureLowLevel(self.offs_.load()); !ready) return failure(ready);
    }
    if (!clock.isVirtual()) self.thread_ = std::thread([&self] { self.run(); });
    return opened;
}

ScienceModeStimulator::~ScienceModeStimulator() {
    forceOff();
    if (thread_.joinable()) {
        {
            const std::scoped_lock state(state_);
            quitting_ = true;
        }
        changed_.notify_one();
        thread_.join();
    }
    const std::scoped_lock io(io_);
    if (exchange_ && !gone_.load())
        endEverything();  // waits for the acks: the bytes are out before the transport closes
}

void ScienceModeStimulator::disconnect() {
    exchange_.reset();
    gone_ = true;
    lowLevelOffs_ = kNotInitialised;
    std::unique_ptr<Transport> old;  // closed after the lock is let go
    const std::scoped_lock urgent(urgent_);
    old = std::move(transport_);
}

Result<Identification> ScienceModeStimulator::connect() {
    disconnect();
    auto transport = connect_();
    if (!transport) return failure(transport);
    {
        const std::scoped_lock urgent(urgent_);
        transport_ = std::move(*transport);
    }
    exchange_ = std::make_unique<Exchange>(*transport_, clock_);
    // Asked before anything else: it may be some other instrument's serial port.
    auto found = identify(*exchange_);
    if (found) {
        gone_ = false;
    } else {
        disconnect();  // not even a stop is for it
    }
    return found;
}

void ScienceModeStimulator::endEverything() {
    // The results do not matter: "not initialised" is as good as "ok".
    for (const auto stop : {Command::LowLevelStop, Command::MidLevelStop}) {
        static_cast<void>(exchange_->ask(stop));
    }
    lowLevelOffs_ = kNotInitialised;
}

Result<void> ScienceModeStimulator::command(Command command, const Payload& payload, std::uint64_t offs) {
    const auto sent = exchange_->send(command, payload.view());
    if (stoppedSince(offs)) sendStop();
    if (exchange_->gone()) gone_ = true;
    if (!sent) return sent;
    const auto answer = exchange_->receive();
    if (exchange_->gone()) gone_ = true;
    if (!answer) return failure(answer);
    const auto result = readPlainAck(command, *answer);
    if (!result) return failure(result);
    if (*result != ResultCode::Ok) return refusal(command, *result);
    return {};
}

Result<void> ScienceModeStimulator::ensureLowLevel(std::uint64_t offs) {
    if (lowLevelOffs_ == offs) return {};
    lowLevelOffs_ = kNotInitialised;
    if (auto done =
            command(Command::LowLevelInit, payloadOf(LowLevelInit{settings_.highVoltage, settings_.measurement}), offs);
        !done) {
        return done;
    }
    lowLevelOffs_ = offs;
    return {};
}

void ScienceModeStimulator::sendStop() noexcept {
    const std::scoped_lock urgent(urgent_);
    if (!transport_) return;
    transport_->writeUrgent(stopFrames().everything());
}

void ScienceModeStimulator::forceOff() noexcept {
    offs_.fetch_add(1, std::memory_order_acq_rel);
    sendStop();
}

bool ScienceModeStimulator::playing() const noexcept { return play_ && !stoppedSince(play_->offs); }

StimulatorStatus ScienceModeStimulator::snapshot(Instant at) const {
    StimulatorStatus status;
    status.at = at;
    status.electrode = reading_.electrode;
    if (reading_.amplitude) status.amplitude = reading_.amplitude->value();
    status.impedance = reading_.impedance;
    status.imbalance = reading_.imbalance;
    status.imbalanceUncertainty = reading_.imbalanceUncertainty;
    status.trainsDelivered = trains_;
    return status;
}

Result<StimulatorStatus> ScienceModeStimulator::status() {
    {
        const std::scoped_lock state(state_);
        if (playing()) {
            auto status = snapshot(clock_.now());
            status.delivering = true;
            status.trainEnd = play_->due + (play_->pulses - play_->sent - 1) * play_->period +
                              toInstant(Seconds(play_->plan.points.duration()));
            return status;
        }
        if (ended_) return tl::unexpected<Error>(*std::exchange(ended_, std::nullopt));
    }
    const std::scoped_lock io(io_);
    if (gone_) {
        const auto found = connect();
        if (!found) {
            return fail(ErrorCode::Device, "stimulator {} is gone and could not be opened again: {}", identity_.serial,
                        found.error().message);
        }
        if (found->id != identity_.serial) {
            disconnect();
            return fail(ErrorCode::Device, "stimulator {} answered where {} was expected", found->id, identity_.serial);
        }
        endEverything();
    }
    return askStatus();
}

Result<StimulatorStatus> ScienceModeStimulator::askStatus() {
    const auto answer = exchange_->ask(Command::StimStatus);
    if (exchange_->gone()) gone_ = true;
    if (!answer) return failure(answer);
    const auto ack = readStimStatusAck(*answer);
    if (!ack) return failure(ack);
    if (ack->result != ResultCode::Ok) return refusal(Command::StimStatus, ack->result);
    const std::scoped_lock state(state_);
    auto status = snapshot(clock_.now());
    status.delivering = ack->status == Stimulation::MidLevelRunning;
    return status;
}

ExchangeCounts ScienceModeStimulator::counts() {
    const std::scoped_lock io(io_);
    return exchange_ ? exchange_->counts() : ExchangeCounts{};
}

}  // namespace tacto::sciencemode
