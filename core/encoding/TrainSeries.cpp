#include "core/encoding/TrainSeries.h"

#include <algorithm>

namespace tacto {

namespace {
/// A pause longer than this many of the longest intervals ends a series.
constexpr double kSilence = 2;
}  // namespace

TrainSeries::TrainSeries(const EncodingProfile& profile, const KnownLines& calibration)
    : encoder_(profile), calibration_(calibration) {}

bool TrainSeries::goesOn(Instant onset) const noexcept {
    return last_ && Seconds(onset - last_->onset) <= kSilence * encoder_.profile().intervalMax;
}

Command TrainSeries::limited(Instant onset) const noexcept {
    if (!goesOn(onset)) return *wanted_;
    auto next = encoder_.limited(last_->command, *wanted_, Seconds(onset - last_->onset));
    if (!startsAgain_) return next;
    next.amplitude = std::min(next.amplitude, wanted_->amplitude);
    next.interval = std::max(next.interval, wanted_->interval);
    return next;
}

void TrainSeries::want(const Command& wanted, Instant now) noexcept {
    const bool starting = !wanted_;
    wanted_ = wanted;
    command_ = limited(now);
    const Seconds interval = programmedFor(command_->interval, calibration_);
    if (starting)
        scheduler_.start(now, interval);
    else
        scheduler_.setInterval(interval, now);
}

void TrainSeries::wantNothing() noexcept {
    wanted_.reset();
    command_.reset();
    scheduler_.off();
    startsAgain_ = true;
}

void TrainSeries::begun(const Command& command, Instant onset) noexcept {
    command_ = command;
    begun_ = Train{command, onset};
    if (!goesOn(onset)) return;
    const Seconds late = Seconds(onset - last_->onset) - programmedFor(command.interval, calibration_);
    const Seconds longest = std::max(command.interval, encoder_.profile().intervalMax);
    begun_->command.interval = std::clamp(command.interval + late, command.interval, longest);
}

Command TrainSeries::begin(Instant onset) noexcept {
    begun(limited(onset), onset);
    scheduler_.trainAt(onset);
    return *command_;
}

bool TrainSeries::follow(const Command& made, Instant onset) noexcept {
    constexpr double kSingle = 1.001;
    constexpr Seconds kClocks{2e-3};
    wantNothing();
    // Whatever intervals it states, its onsets may not come sooner than the profile lets pressure bring them.
    if (last_ && Seconds(onset - last_->onset) + kClocks < encoder_.profile().intervalMin) return false;
    if (goesOn(onset)) {
        const auto most = encoder_.limited(last_->command, made, Seconds(onset - last_->onset) + kClocks);
        const bool permitted = made.amplitude <= most.amplitude * kSingle && made.interval * kSingle >= most.interval;
        if (!permitted) return false;
    }
    begun(made, onset);
    return true;
}

void TrainSeries::delivered() noexcept {
    if (begun_) last_ = begun_;
    startsAgain_ = false;
}

namespace {
/// Rounds up to whole nanoseconds, so that a train is never early.
Instant wholeNanoseconds(Seconds interval) noexcept {
    const Instant nearest = toInstant(interval);
    return Seconds(nearest) < interval ? nearest + Instant(1) : nearest;
}

bool isUsable(Seconds interval) noexcept { return interval.count() > 0 && interval.count() <= 1e6; }
}  // namespace

void TrainScheduler::start(Instant now, Seconds interval) noexcept {
    if (!isUsable(interval)) return;
    interval_ = interval;
    running_ = true;
    reschedule(now);
}

void TrainScheduler::setInterval(Seconds interval, Instant now) noexcept {
    if (!isUsable(interval) || interval == interval_ || !running_) return;
    interval_ = interval;
    reschedule(now);
}

void TrainScheduler::trainAt(Instant onset) noexcept {
    last_ = last_ ? std::max(*last_, onset) : onset;
    due_ = *last_ + wholeNanoseconds(interval_);
}

void TrainScheduler::reschedule(Instant notBefore) noexcept {
    due_ = last_ ? std::max(notBefore, *last_ + wholeNanoseconds(interval_)) : notBefore;
}

}  // namespace tacto
