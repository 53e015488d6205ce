// How a train becomes pulses on the wire: deliver(), and the driver's own thread.
#include <algorithm>
#include <utility>

#include "drivers/sciencemode/ScienceModeStimulator.h"

namespace tacto::sciencemode {
namespace {

/// A pulse this much of a period late moves those after it, so that none follows too fast.
constexpr double kGridSlack = 0.1;

}  // namespace

Result<void> ScienceModeStimulator::accepts(const ApprovedTrain& train) {
    const Instant now = clock_.now();
    if (!(now <= train.expires())) {
        return fail(ErrorCode::Device, "the stimulator refused a train whose approval expired {:.1f} ms ago",
                    toSeconds(now - train.expires()) * 1e3);
    }
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
    // Afterwards: a thread that was held up on its way to the wire has sent this pulse no later than now, and none
    // may follow it too fast.
    written = clock_.now();
    // A stop that came while the write was in flight may have reached the device before it: off again.
    if (stoppedSince(offs)) sendStop();
    if (exchange_->gone()) gone_ = true;
    if (!sent) return failure(sent);
    const auto answer = exchange_->receive(kAnswerTime + Seconds(plan.points.duration()));
    if (exchange_->gone()) gone_ = true;
    if (stoppedSince(offs)) return Sent::Stopped;  // even on an error: the stop may have been faster
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

Result<void> ScienceModeStimulator::keepAlive() {
    if (gone_) return fail(ErrorCode::Device, "stimulator {} is gone: unplugged, or its bus failed", identity_.serial);
    return {};
}

}  // namespace tacto::sciencemode
