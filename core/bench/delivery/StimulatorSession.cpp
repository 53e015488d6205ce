#include "core/bench/delivery/StimulatorSession.h"

#include <algorithm>
#include <utility>

#include "core/devices/DeviceUri.h"
#include "core/safety/TrainCheck.h"

namespace tacto {

namespace {
constexpr Instant kStimulatorPoll = std::chrono::milliseconds(20);
constexpr Instant kStatusDelay = std::chrono::milliseconds(2);
constexpr Instant kStatusRetry = std::chrono::milliseconds(5);

/// Returns the time from the onset of the first pulse to the end of the last pulse.
Instant durationOf(const PulseTrain& train) noexcept {
    return toInstant((train.pulses - 1) / train.rate.value()) + toInstant(train.pulseDuration());
}

/// True if the values are readings: an open electrode may read as infinite, but not as NaN or negative.
bool isPlausible(const StimulatorStatus& status) noexcept {
    const auto fine = [](double value) { return value >= 0; };
    return (!status.amplitude || fine(*status.amplitude)) && (!status.impedance || fine(status.impedance->value())) &&
           (!status.imbalance || fine(*status.imbalance)) &&
           (!status.imbalanceUncertainty || fine(*status.imbalanceUncertainty));
}
}  // namespace

Result<std::unique_ptr<UnitRecord>> takeUpUnit(const DeviceIdentity& stimulator, const UnitFolders& folders,
                                               const Clock& clock, const SystemTime& time, SafetyGate& gate) {
    auto record = UnitRecord::open(folders, unitOf(stimulator.serial, stimulator.uri), clock, time);
    if (record) gate.continueFrom(**record);
    return record;
}

Instant StimulatorSession::latestEnd(const PulseTrain& train, Instant onset) noexcept {
    return onset + kBeginsWithin + durationOf(train);
}

void StimulatorSession::post(ApprovedTrain&& train, Instant onset, bool isCheck) noexcept {
    trainEnd_.store(latestEnd(train.train(), onset).count(), std::memory_order_release);
    saysItDelivers_.store(false, std::memory_order_release);
    OutputSession::post({std::move(train), onset, isCheck});
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
    if (awaitingStatus_) return next;
    if (auto due = takeDue(now, next)) {
        deliver(std::move(*due), now);
        if (awaitingStatus_) next = std::min(next, statusDue_);
    }
    return next;
}

void StimulatorSession::deliver(TrainOrder&& order, Instant now) noexcept {
    TrainReport made;
    made.isCheck = order.isCheck;
    made.onset = now;
    made.amplitude = std::visit([](auto a) { return a.value(); }, order.train.train().amplitude);
    made.interval_s = order.train.interval().count();
    made.train = order.train.train();
    made.approvedUntil = order.train.expires();
    const Instant duration = durationOf(made.train);
    const auto delivered = writeIfCurrent(order.train, [&] { return device_.deliver(std::move(order.train)); });
    if (!delivered) return report(made);
    if (!*delivered) {
        made.fail(delivered->error());
        return report(made);
    }
    // Programming the device may have taken time: the train began after that, not when it was ordered.
    made.end = std::max(now, clock_.now()) + duration;
    trainEnd_.store(made.end.count(), std::memory_order_release);
    awaitingStatus_ = made;
    statusDue_ = made.end + kStatusDelay;
}

void StimulatorSession::readStatus(Instant now) noexcept {
    TrainReport made = *awaitingStatus_;
    const auto status = device_.status();
    saysItDelivers_.store(status && status->delivering, std::memory_order_release);
    if (status && status->delivering) {
        if (status->trainEnd && *status->trainEnd > made.end) {
            awaitingStatus_->end = made.end = *status->trainEnd;
            trainEnd_.store(made.end.count(), std::memory_order_release);
        }
        if (now < made.end + kStatusDeadline) {
            // A device that is only slow to finish has until the deadline.
            statusDue_ = std::max(now + kStatusRetry, made.end + kStatusDelay);
            return;
        }
    }
    awaitingStatus_.reset();
    made.statusAt = std::max(now, clock_.now());
    if (!status || !isPlausible(*status)) {
        device_.forceOff();
        made.fail(status ? Error{ErrorCode::Device, "the stimulator's status holds a value that no measurement gives"}
                         : status.error());
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
    if (!watchLoop(now)) return keptAliveAt_.reset();
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
        lost.onset = lost.statusAt = now;
        lost.fail(kept.error());
        note(lost);
    }
}

}  // namespace tacto
