#include "drivers/sciencemode/ScienceModeStimulator.h"

#include <algorithm>
#include <utility>

#include "core/devices/Device.h"

namespace tacto::sciencemode {

namespace {

/// A pulse that is late by more than this share of a period delays the later pulses, so that none follows too soon.
constexpr double kGridSlack = 0.1;

/// True if the train must end: after a pulse with an electrode that is open, shorted or unknown none follows.
bool endsTrain(const PulseReading& reading, const SourceTraits& traits) noexcept {
    return reading.electrode == ElectrodeState::Open || reading.electrode == ElectrodeState::Short ||
           (traits.readsBack && !reading.impedance);
}

}  // namespace

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
                          settings.emulated};
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
        endEverything();  // waits for the acks, so the bytes are sent before the transport closes
}

void ScienceModeStimulator::disconnect() {
    exchange_.reset();
    gone_ = true;
    lowLevelOffs_ = kNotInitialised;
    std::unique_ptr<Transport> old;  // closed after the lock is released
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
    // Identifies the device before anything else: the port may belong to some other instrument.
    auto found = identify(*exchange_, settings_.emulated);
    if (found) {
        gone_ = false;
    } else {
        disconnect();  // another unit: send it nothing, not even a stop
    }
    return found;
}

void ScienceModeStimulator::endEverything() {
    // The results are ignored: "not initialised" is as good as "ok".
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
    const std::scoped_lock state(state_);
    auto status = snapshot(clock_.now());
    status.delivering = ack->status == Stimulation::MidLevelRunning;
    return status;
}

ExchangeCounts ScienceModeStimulator::counts() {
    const std::scoped_lock io(io_);
    return exchange_ ? exchange_->counts() : ExchangeCounts{};
}

Result<void> ScienceModeStimulator::accepts(const ApprovedTrain& train) {
    const Instant now = clock_.now();
    if (auto current = notExpired(train.expires(), now, "the stimulator", "a train"); !current) return current;
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    const std::scoped_lock state(state_);
    if (playing()) return fail(ErrorCode::Device, "the stimulator refused a train while another is in progress");
    return {};
}

Result<ScienceModeStimulator::Sent> ScienceModeStimulator::firePulse(const PulsePlan& plan, const Payload& request,
                                                                     std::uint64_t offs, PulseReading& reading,
                                                                     Instant& written) {
    if (stoppedSince(offs)) return Sent::Stopped;
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    const auto sent = exchange_->send(Command::ChannelConfig, request.view());
    // Read after the write: even if this thread was delayed before it, the pulse was sent no later than now, so the
    // next pulse cannot follow too soon.
    written = clock_.now();
    // A stop that came during the write may have reached the device before the pulse: send it again.
    if (stoppedSince(offs)) sendStop();
    if (exchange_->gone()) gone_ = true;
    if (!sent) return failure(sent);
    const auto answer = exchange_->receive(kAnswerTime + Seconds(plan.points.duration()));
    if (exchange_->gone()) gone_ = true;
    if (stoppedSince(offs)) return Sent::Stopped;  // even after an error: the stop may have come first
    if (!answer) return failure(answer);
    ChannelConfigAck ack;
    if (const auto read = readChannelConfigAck(*answer, ack); !read) return failure(read);
    if (ack.result != ResultCode::Ok && ack.result != ResultCode::Electrode) {
        return refusal(Command::ChannelConfig, ack.result);
    }
    if (ack.complete && (ack.channel != settings_.channel || ack.connector != settings_.connector)) {
        return fail(ErrorCode::Device,
                    "the stimulator answered for channel {} of connector {}; channel {} of connector {} was used",
                    ack.channel, ack.connector, settings_.channel, settings_.connector);
    }
    if (ack.measured && ack.measurement != settings_.measurement) {
        return fail(ErrorCode::Device, "the stimulator measured quantity {} of the pulse; {} was asked for",
                    static_cast<int>(ack.measurement), static_cast<int>(settings_.measurement));
    }
    reading = readPulse(ack, plan, traits_.compliance);
    return Sent::Answered;
}

Result<void> ScienceModeStimulator::deliver(ApprovedTrain&& train) {
    const ApprovedTrain consumed = std::move(train);
    const auto offs = offs_.load(std::memory_order_acquire);
    const auto plan = planPulse(consumed.train());
    if (!plan) return failure(plan);
    const auto request = payloadOf(ChannelConfig{settings_.channel, settings_.connector, true, plan->points});
    if (!request) return failure(request);

    const std::scoped_lock io(io_);
    if (const auto ready = accepts(consumed); !ready) return ready;
    if (const auto low = ensureLowLevel(offs); !low) {
        if (stoppedSince(offs)) return {};
        return low;
    }
    if (const auto still = accepts(consumed); !still) return still;  // check again: initialising took time
    PulseReading reading;
    Instant first{0};
    const auto fired = firePulse(*plan, *request, offs, reading, first);
    if (!fired) {
        lowLevelOffs_ = kNotInitialised;
        return failure(fired);
    }
    if (*fired == Sent::Stopped) return {};
    {
        const std::scoped_lock state(state_);
        ++trains_;
        reading_ = reading;
        ended_.reset();
        play_.reset();
        if (consumed.train().pulses > 1 && !endsTrain(reading, traits_)) {
            const Instant period = toInstant(1 / consumed.train().rate.value());
            play_ = Play{*plan, *request, consumed.train().pulses, 1, period, clock_.asleep(), first + period, offs};
        }
    }
    changed_.notify_one();
    return {};
}

Instant ScienceModeStimulator::serve(Instant now) noexcept {
    {
        const std::scoped_lock state(state_);
        if (!playing()) {
            play_.reset();
            return Instant::max();
        }
        if (now < play_->due) return play_->due;
    }
    firePlayed(now);
    const std::scoped_lock state(state_);
    return playing() ? play_->due : Instant::max();
}

void ScienceModeStimulator::firePlayed(Instant now) {
    const std::scoped_lock io(io_);
    Play play;
    {
        const std::scoped_lock state(state_);
        if (!playing() || now < play_->due) return;  // another train may be playing by now
        play = *play_;
    }
    // Judges each pulse by its own interval, because late pulses delay those after them. Time that the computer slept
    // counts as lateness.
    const Instant late = now - play.due + (clock_.asleep() - play.asleep);
    PulseReading reading;
    Instant written{0};
    Result<Sent> fired = Sent::Stopped;
    if (late > toInstant(kMaxLate)) {
        fired = fail(ErrorCode::Timeout,
                     "the train was abandoned: pulse {} of {} would have been {:.0f} ms late, at most {:.0f} ms is "
                     "accepted",
                     play.sent + 1, play.pulses, toSeconds(late) * 1e3, kMaxLate.count() * 1e3);
    } else {
        fired = firePulse(play.plan, play.request, play.offs, reading, written);
    }
    if (!fired) {
        // No caller waits for this answer, so nobody else would switch off.
        forceOff();
        lowLevelOffs_ = kNotInitialised;
    }
    const std::scoped_lock state(state_);
    if (!fired) {
        ended_ = fired.error();
        play_.reset();
        return;
    }
    if (*fired == Sent::Stopped) {
        play_.reset();
        return;
    }
    reading_ = reading;
    ++play_->sent;
    if (play_->sent >= play_->pulses || endsTrain(reading, traits_)) {
        play_.reset();
        return;
    }
    const Instant slip = written - play.due;
    const auto slack = toInstant(toSeconds(play.period) * kGridSlack);
    play_->due = (slip > slack ? written : play.due) + play.period;
}

void ScienceModeStimulator::run() {
    std::unique_lock state(state_);
    while (!quitting_) {
        state.unlock();
        const Instant next = serve(clock_.now());
        state.lock();
        if (quitting_) break;
        const bool idle = !play_;
        if (idle) {
            changed_.wait(state, [this] { return quitting_ || play_.has_value(); });
        } else if (const auto left = std::min(next, play_->due) - clock_.now(); left.count() > 0) {
            changed_.wait_for(state, left);  // a newer train wakes it early: look again
        }
    }
}

Result<void> ScienceModeStimulator::keepAlive() {
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    return {};
}

}  // namespace tacto::sciencemode
