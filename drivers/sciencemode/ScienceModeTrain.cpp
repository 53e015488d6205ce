// How a train becomes pulses on the wire: deliver(), the driver's own thread, and mid level.
#include <algorithm>
#include <utility>

#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto::sciencemode {
namespace {

/// A pulse this much of a period late moves those after it, so that none follows too fast.
constexpr double kGridSlack = 0.1;

std::size_t midChannelOf(const StimulatorSettings& settings) noexcept {
    const int channel = 4 * settings.connector + settings.channel;
    return static_cast<std::size_t>(channel);
}

}  // namespace

Result<void> ScienceModeStimulator::accepts(const ApprovedTrain& train) {
    const Instant now = clock_.now();
    if (!(now <= train.expires())) {
        return fail(ErrorCode::Device, "the stimulator refused a train whose approval expired {:.1f} ms ago",
                    toSeconds(now - train.expires()) * 1e3);
    }
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    if (repeating()) return fail(ErrorCode::Device, "the stimulator refused a train while another repeats");
    const std::scoped_lock state(state_);
    if (playing()) return fail(ErrorCode::Device, "the stimulator refused a train while another is in progress");
    return {};
}

Result<ScienceModeStimulator::Sent> ScienceModeStimulator::firePulse(const PulsePlan& plan, const Payload& request,
                                                                     std::uint64_t offs, PulseReading& reading,
                                                                     Instant& written) {
    if (stoppedSince(offs)) return Sent::Stopped;
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    written = clock_.now();
    const auto sent = exchange_->send(Command::ChannelConfig, request.view());
    // A stop that came while the write was in flight may have reached the device before it: off again.
    if (stoppedSince(offs)) sendStop();
    if (exchange_->gone()) gone_ = true;
    if (!sent) return failure(sent);
    const auto answer = exchange_->receive(kAnswerTime + Seconds(plan.points.duration()));
    if (exchange_->gone()) gone_ = true;
    if (stoppedSince(offs)) return Sent::Stopped;  // whatever it says: the stop may have been faster
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
    if (const auto still = accepts(consumed); !still) return still;  // initialising took time
    PulseReading reading;
    Instant first{0};
    const auto fired = firePulse(*plan, *request, offs, reading, first);
    if (!fired) {
        level_ = Level::None;
        return failure(fired);
    }
    if (*fired == Sent::Stopped) return {};
    {
        const std::scoped_lock state(state_);
        ++trains_;
        reading_ = reading;
        ended_.reset();
        play_.reset();
        if (consumed.train().pulses > 1 && reading.electrode != ElectrodeState::Open) {
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
        if (!playing() || now < play_->due) return;  // another train by now
        play = *play_;
    }
    // Each pulse is judged on its own interval: those before it have slipped, and moved it. A computer that slept is
    // late.
    const Instant late = now - play.due + (clock_.asleep() - play.asleep);
    PulseReading reading;
    Instant written{0};
    Result<Sent> fired = Sent::Stopped;
    if (late > toInstant(kMaxLate)) {
        fired = fail(ErrorCode::Device,
                     "the train was given up: pulse {} of {} would have been {:.0f} ms late, at most {:.0f} ms is "
                     "accepted",
                     play.sent + 1, play.pulses, toSeconds(late) * 1e3, kMaxLate.count() * 1e3);
    } else {
        fired = firePulse(play.plan, play.request, play.offs, reading, written);
    }
    if (!fired) {
        // No caller waits for this answer, so no other would switch off.
        forceOff();
        level_ = Level::None;
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
    if (play_->sent >= play_->pulses || reading.electrode == ElectrodeState::Open) {
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
            changed_.wait_for(state, left);  // woken early by a newer train: looks again
        }
    }
}

Result<void> ScienceModeStimulator::repeat(ApprovedTrain&& train, Seconds interval) {
    const ApprovedTrain consumed = std::move(train);
    const auto offs = offs_.load(std::memory_order_acquire);
    if (!settings_.midLevel) {
        return fail(ErrorCode::Unsupported, "the stimulator was opened for low level and repeats nothing");
    }
    if (!(interval >= consumed.interval() - Seconds(1e-9))) {
        return fail(ErrorCode::Device, "the stimulator refused to repeat every {:.3f} s what was approved for {:.3f} s",
                    interval.count(), consumed.interval().count());
    }
    const auto points = planRepetition(consumed.train());
    if (!points) return failure(points);
    MidLevelUpdate update;
    const auto index = midChannelOf(settings_);
    update.channels[index] = MidLevelChannel{static_cast<int>(index), 0, interval, *points};
    const auto request = payloadOf(update);
    if (!request) return fail(ErrorCode::Device, "{}", request.error().message);

    const std::scoped_lock io(io_);
    if (const auto ready = accepts(consumed); !ready) return ready;
    level_ = Level::None;
    if (auto done = command(Command::MidLevelInit, midLevelInitPayload(true), offs); !done) return done;
    if (const auto still = accepts(consumed); !still) return still;
    if (stoppedSince(offs)) return {};
    const auto updated = command(Command::MidLevelUpdate, *request, offs);
    if (stoppedSince(offs)) return {};
    if (!updated) return updated;
    level_ = Level::Mid;
    levelOffs_ = offs;
    midOffs_ = offs;
    const std::scoped_lock state(state_);
    ++trains_;
    reading_ = {};
    ended_.reset();
    return {};
}

Result<void> ScienceModeStimulator::keepAlive() {
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    if (!repeating()) return {};
    const std::scoped_lock io(io_);
    const auto answer = exchange_->ask(Command::CurrentData, currentDataPayload().view());
    if (exchange_->gone()) gone_ = true;
    if (!repeating()) return {};  // stopped meanwhile
    if (!answer) return failure(answer);
    const auto ack = readCurrentDataAck(*answer);
    if (!ack) return failure(ack);
    if (ack->result != ResultCode::Ok && ack->result != ResultCode::Electrode) {
        return refusal(Command::CurrentData, ack->result);
    }
    const auto index = midChannelOf(settings_);
    const auto channel = ack->channels[index];
    {
        const std::scoped_lock state(state_);
        reading_.electrode = channel == ChannelState::ElectrodeOff || ack->result == ResultCode::Electrode
                                 ? ElectrodeState::Open
                                 : ElectrodeState::NotMeasured;
    }
    if (channel != ChannelState::Ok || ack->result != ResultCode::Ok) {
        forceOff();
        const auto what = channel != ChannelState::Ok ? meaningOf(channel) : meaningOf(ack->result);
        return fail(ErrorCode::Device, "the stimulator's repetition was ended because {}", what);
    }
    if ((ack->running >> index & 1U) == 0) {
        forceOff();
        return fail(ErrorCode::Device,
                    "the stimulator's repetition has stopped by itself: its dead-man time of 2 s had passed");
    }
    return {};
}

}  // namespace tacto::sciencemode
