#include "core/encoding/TrainScheduler.h"

#include <algorithm>

namespace tacto {
namespace {
/// Rounded up to whole nanoseconds, so that rounding never makes a train early.
Instant wholeNanoseconds(Seconds interval) noexcept {
    const Instant nearest = toInstant(interval);
    return Seconds(nearest) < interval ? nearest + Instant(1) : nearest;
}

bool isUsable(Seconds interval) noexcept { return interval.count() > 0 && interval.count() <= 1e6; }
}  // namespace

void TrainScheduler::start(Instant now, Seconds interval) noexcept {
    if (!isUsable(interval)) return;
    interval_ = interval;
    mode_ = Mode::Running;
    reschedule(now);
}

void TrainScheduler::setInterval(Seconds interval, Instant now) noexcept {
    if (!isUsable(interval) || interval == interval_ || mode_ == Mode::Off) return;
    interval_ = interval;
    if (mode_ == Mode::Running) reschedule(now);
}

void TrainScheduler::pause() noexcept {
    if (mode_ == Mode::Running) mode_ = Mode::Paused;
}

void TrainScheduler::resume(Instant now) noexcept {
    if (mode_ != Mode::Paused) return;
    mode_ = Mode::Running;
    reschedule(now);
}

void TrainScheduler::off() noexcept { mode_ = Mode::Off; }

std::optional<Instant> TrainScheduler::due() const noexcept {
    if (mode_ != Mode::Running) return std::nullopt;
    return due_;
}

bool TrainScheduler::isDue(Instant now) const noexcept { return mode_ == Mode::Running && now >= due_; }

void TrainScheduler::trainAt(Instant onset) noexcept {
    last_ = last_ ? std::max(*last_, onset) : onset;
    due_ = *last_ + wholeNanoseconds(interval_);
}

void TrainScheduler::reschedule(Instant notBefore) noexcept {
    due_ = last_ ? std::max(notBefore, *last_ + wholeNanoseconds(interval_)) : notBefore;
}

}  // namespace tacto
