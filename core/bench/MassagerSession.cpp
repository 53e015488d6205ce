#include "core/bench/MassagerSession.h"

#include <algorithm>
#include <utility>

namespace tacto {

namespace {
constexpr Instant kMassagerPoll = std::chrono::milliseconds(20);
}

MassagerSession::MassagerSession(Massager& device, const SafetyGate& gate, const Heartbeat& heartbeat,
                                 const Clock& clock, std::function<void()> wake)
    : device_(device), gate_(gate), heartbeat_(heartbeat), clock_(clock), wake_(std::move(wake)) {}

void MassagerSession::post(ApprovedBurst&& burst, Instant onset, Seconds interval) noexcept {
    {
        const std::scoped_lock lock(mailbox_);
        pending_.emplace(Pending{std::move(burst), onset, interval});
        busy_.store(true, std::memory_order_release);
    }
    if (wake_) wake_();
}

void MassagerSession::forceOff() noexcept {
    offs_.fetch_add(1, std::memory_order_acq_rel);
    device_.forceOff();
}

Instant MassagerSession::serve(Instant now) noexcept {
    Instant next = now + kMassagerPoll;
    watchLoop(now);
    std::optional<Pending> due;
    {
        const std::scoped_lock lock(mailbox_);
        if (pending_) {
            if (now >= pending_->onset) {
                due = std::move(pending_);
                pending_.reset();
            } else {
                next = std::min(next, pending_->onset);
            }
        }
    }
    if (due) send(std::move(*due), now);
    return next;
}

void MassagerSession::send(Pending&& pending, Instant now) noexcept {
    const auto burst = pending.burst.burst();
    TrainReport made;
    made.onset = made.statusAt = now;
    made.end = now + toInstant(burst.duration);
    made.amplitude = burst.intensity;
    made.interval_s = pending.interval.count();
    const auto offsBefore = offs_.load(std::memory_order_acquire);
    if (gate_.isCurrent(pending.burst) && heartbeat_.alive(clock_.elapsed())) {
        const auto sent = device_.vibrate(std::move(pending.burst));
        // A stop that came while the write was in flight may have reached the device before it: off again. So may a
        // standstill of the process, or of the computer, that the write waited through.
        if (!sent || offs_.load(std::memory_order_acquire) != offsBefore || !heartbeat_.alive(clock_.elapsed())) {
            device_.forceOff();
        }
        made.outcome = sent ? TrainOutcome::Delivered : TrainOutcome::Failed;
        if (!sent) made.error = std::string_view(sent.error().message);
        made.statusAt = std::max(now, clock_.now());
    }
    reports_.push(made);
    busy_.store(false, std::memory_order_release);
}

void MassagerSession::watchLoop(Instant now) noexcept {
    if (heartbeat_.alive(clock_.elapsed())) {
        everServed_ = true;
        silenced_ = false;
        return;
    }
    // Said once, for the loop to find when it comes back.
    if (std::exchange(silenced_, true) || !everServed_) return;
    device_.forceOff();
    TrainReport silent;
    silent.outcome = TrainOutcome::LoopSilent;
    silent.onset = silent.statusAt = now;
    silent.error = std::string_view("the control loop was silent for more than 100 ms");
    reports_.push(silent);
}

}  // namespace tacto
