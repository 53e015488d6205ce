#include "core/bench/delivery/OutputSession.h"

namespace tacto {

namespace {
constexpr Instant kMassagerPoll = std::chrono::milliseconds(20);
}

Instant MassagerSession::serve(Instant now) noexcept {
    Instant next = now + kMassagerPoll;
    static_cast<void>(watchLoop(now));
    if (auto due = takeDue(now, next)) send(std::move(*due), now);
    return next;
}

void MassagerSession::send(BurstOrder&& order, Instant now) noexcept {
    const auto burst = order.burst.burst();
    TrainReport made;
    made.onset = made.statusAt = now;
    made.end = now + toInstant(burst.duration);
    made.amplitude = burst.intensity;
    made.interval_s = order.interval.count();
    const auto sent = writeIfCurrent(order.burst, [&] { return device_.vibrate(std::move(order.burst)); });
    if (sent) {
        made.outcome = TrainOutcome::Delivered;
        if (!*sent) made.fail(sent->error());
        made.statusAt = std::max(now, clock_.now());
    }
    report(made);
}

}  // namespace tacto
