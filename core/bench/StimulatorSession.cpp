#include "core/bench/StimulatorSession.h"

#include <algorithm>
#include <utility>

#include "core/safety/TrainCheck.h"

namespace tacto {

namespace {
constexpr Instant kStimulatorPoll = std::chrono::milliseconds(20);
constexpr Instant kStatusDelay = std::chrono::milliseconds(2);
constexpr Instant kStatusRetry = std::chrono::milliseconds(5);

/// From the onset of the first pulse to the end of the last.
Instant durationOf(const PulseTrain& train) noexcept {
    return toInstant((train.pulses - 1) / train.rate.value()) + toInstant(train.pulseDuration());
}

/// An open electrode may read as infinite; NaN and negative numbers are no readings.
bool isPlausible(const StimulatorStatus& status) noexcept {
    const auto fine = [](double value) { return value >= 0; };
    return (!status.amplitude || fine(*status.amplitude)) && (!status.impedance || fine(status.impedance->value())) &&
           (!status.imbalance || fine(*status.imbalance)) &&
           (!status.imbalanceUncertainty || fine(*status.imbalanceUncertainty));
}
}  // namespace

StimulatorSession::StimulatorSession(Stimulator& device, const SafetyGate& gate, const Heartbeat& heartbeat,
                                     const Clock& clock, std::function<void()> wake)
    : device_(device), gate_(gate), heartbeat_(heartbeat), clock_(clock), wake_(std::move(wake)) {}

void StimulatorSession::post(ApprovedTrain&& train, Instant onset, bool isCheck) noexcept {
    const Instant latest = onset + kBeginsWithin + durationOf(train.train());
    trainEnd_.store(latest.count(), std::memory_order_release);
    {
        const std::scoped_lock lock(mailbox_);
        pending_.emplace(Pending{std::move(train), onset, isCheck});
        busy_.store(true, std::memory_order_release);
    }
    if (wake_) wake_();
}

void StimulatorSession::forceOff() noexcept {
    offs_.fetch_add(1, std::memory_order_acq_rel);
    device_.forceOff();
}

Instant StimulatorSession::serve(Instant now) noexcept {
    Instant next = now + kStimulatorPoll;
    feedDeadMan(now);
    if (healthAsked_.exchange(false, std::memory_order_acq_rel)) answerHealth();
    if (awaitingStatus_) {
        if (now >= statusDue_)
            readStatus(now);
        else
            next = std::min(next, statusDue_);
    }
    std::optional<Pending> due;
    {
        const std::scoped_lock lock(mailbox_);
        if (pending_ && !awaitingStatus_) {
            if (now >= pending_->onset) {
                due = std::move(pending_);
                pending_.reset();
            } else {
                next = std::min(next, pending_->onset);
            }
        }
    }
    if (due) {
        deliver(std::move(*due), now);
        if (awaitingStatus_) next = std::min(next, statusDue_);
    }
    return next;
}

void StimulatorSession::deliver(Pending&& pending, Instant now) noexcept {
    TrainReport made;
    made.isCheck = pending.isCheck;
    made.onset = now;
    made.amplitude = std::visit([](auto a) { return a.value(); }, pending.train.train().amplitude);
    made.interval_s = pending.train.interval().count();
    made.train = pending.train.train();
    made.approvedUntil = pending.train.expires();
    const auto offsBefore = offs_.load(std::memory_order_acquire);
    if (!gate_.isCurrent(pending.train) || !heartbeat_.alive(clock_.elapsed())) {
        report(made);
        return;
    }
    const Instant duration = durationOf(pending.train.train());
    const auto delivered = device_.deliver(std::move(pending.train));
    // A stop that came while the write was in flight may have reached the device before it: off again. So may a
    // standstill of the process, or of the computer, that the write waited through.
    if (offs_.load(std::memory_order_acquire) != offsBefore || !heartbeat_.alive(clock_.elapsed())) {
        device_.forceOff();
    }
    if (!delivered) {
        device_.forceOff();
        made.outcome = TrainOutcome::Failed;
        made.error = std::string_view(delivered.error().message);
        report(made);
        return;
    }
    // The device may have taken its time to be programmed: the train began when it had, not when it was told to.
    made.end = std::max(now, clock_.now()) + duration;
    trainEnd_.store(made.end.count(), std::memory_order_release);
    awaitingStatus_ = made;
    statusDue_ = made.end + kStatusDelay;
}

void StimulatorSession::readStatus(Instant now) noexcept {
    TrainReport made = *awaitingStatus_;
    const auto status = device_.status();
    if (status && status->delivering) {
        if (status->trainEnd && *status->trainEnd > made.end) {
            awaitingStatus_->end = made.end = *status->trainEnd;
            trainEnd_.store(made.end.count(), std::memory_order_release);
        }
        if (now < made.end + kStatusDeadline) {
            // A device that is merely slow to end has until the deadline.
            statusDue_ = std::max(now + kStatusRetry, made.end + kStatusDelay);
            return;
        }
    }
    awaitingStatus_.reset();
    made.statusAt = std::max(now, clock_.now());
    if (!status || !isPlausible(*status)) {
        device_.forceOff();
        made.outcome = TrainOutcome::Failed;
        made.error = status ? std::string_view("the stimulator's status holds a value that no measurement gives")
                            : std::string_view(status.error().message);
        return report(made);
    }
    made.outcome = TrainOutcome::Delivered;
    made.stillDelivering = status->delivering;
    made.electrode = status->electrode;
    if (status->amplitude) made.measured = *status->amplitude;
    if (status->impedance) made.impedance_ohm = status->impedance->value();
    if (status->imbalance) made.imbalance = *status->imbalance;
    if (status->imbalanceUncertainty) made.imbalanceUncertainty = *status->imbalanceUncertainty;
    report(made);
}

void StimulatorSession::answerHealth() noexcept {
    const auto status = device_.status();
    Result<void> answer;
    if (!status)
        answer = failure(status);
    else if (!isPlausible(*status))
        answer = fail(ErrorCode::Device, "the stimulator's status holds no readings");
    else if (status->delivering)
        answer = fail(ErrorCode::Device, "the stimulator still delivers");
    const std::scoped_lock lock(mailbox_);
    health_ = std::move(answer);
}

std::optional<Result<void>> StimulatorSession::health() {
    const std::scoped_lock lock(mailbox_);
    return std::exchange(health_, std::nullopt);
}

void StimulatorSession::feedDeadMan(Instant now) noexcept {
    if (!heartbeat_.alive(clock_.elapsed())) {
        keptAliveAt_.reset();
        // The loop is silent: whatever the device still does on its own has to end. Said once, for the loop to find
        // when it comes back.
        if (!std::exchange(silenced_, true) && everServed_) {
            device_.forceOff();
            const auto silence = heartbeat_.silence(clock_.elapsed()).value_or(Instant(0));
            silencedAfter_.store(silence.count(), std::memory_order_relaxed);
            TrainReport silent;
            silent.outcome = TrainOutcome::LoopSilent;
            silent.onset = silent.statusAt = now;
            silent.error = std::string_view("the control loop was silent for more than 100 ms");
            reports_.push(silent);
        }
        return;
    }
    everServed_ = true;
    silenced_ = false;
    const auto deadMan = device_.traits().deadMan;
    if (deadMan.count() <= 0 || now < keepAliveDue_) return;
    keepAliveDue_ = now + toInstant(deadMan / 8);
    const Instant sent = clock_.now();
    if (keptAliveAt_) {
        const auto gap = (sent - *keptAliveAt_).count();
        if (gap > longestGap_.load(std::memory_order_relaxed)) longestGap_.store(gap, std::memory_order_relaxed);
    }
    keptAliveAt_ = sent;
    if (const auto kept = device_.keepAlive(); !kept) {
        device_.forceOff();
        TrainReport lost;
        lost.outcome = TrainOutcome::Failed;
        lost.onset = lost.statusAt = now;
        lost.error = std::string_view(kept.error().message);
        reports_.push(lost);
    }
}

void StimulatorSession::report(const TrainReport& made) noexcept {
    reports_.push(made);
    busy_.store(false, std::memory_order_release);
}

}  // namespace tacto
