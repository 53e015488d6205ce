#include "core/base/Clock.h"

#include <algorithm>
#include <ctime>
#include <string>

namespace tacto {

namespace {

Instant read(clockid_t clock) noexcept {
    std::timespec at{};
    clock_gettime(clock, &at);
    return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
}

/// CLOCK_BOOTTIME counts on while the computer sleeps, CLOCK_MONOTONIC (the steady clock) does not. The two are not
/// read in one instruction: a reading that a pause came between is taken again, or the pause would pass for sleep.
Instant asleepSinceBoot() noexcept {
    constexpr Instant kTogether = std::chrono::milliseconds(1);
    constexpr int kAttempts = 100;
    Instant asleep{0};
    for (int i = 0; i < kAttempts; ++i) {
        const Instant before = read(CLOCK_MONOTONIC);
        asleep = read(CLOCK_BOOTTIME) - before;
        if (read(CLOCK_MONOTONIC) - before <= kTogether) break;
    }
    return asleep;
}

}  // namespace

SteadyClock::SteadyClock() noexcept : start_(std::chrono::steady_clock::now()), asleepAtStart_(asleepSinceBoot()) {}

Instant SteadyClock::asleep() const noexcept { return std::max(Instant(0), asleepSinceBoot() - asleepAtStart_); }

Instant SteadyClock::now() const noexcept {
    return std::chrono::duration_cast<Instant>(std::chrono::steady_clock::now() - start_);
}

Instant VirtualClock::now() const noexcept { return Instant(now_.load(std::memory_order_acquire)); }

void VirtualClock::advanceTo(Instant moment) noexcept {
    if (moment.count() > now_.load(std::memory_order_relaxed)) {
        now_.store(moment.count(), std::memory_order_release);
    }
}

Instant VirtualClock::asleep() const noexcept { return Instant(asleep_.load(std::memory_order_acquire)); }

void VirtualClock::sleepFor(Instant duration) noexcept {
    if (duration.count() > 0) asleep_.fetch_add(duration.count(), std::memory_order_acq_rel);
}

std::string wallTimeUtc() {
    const std::time_t seconds = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[32];
    const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return {text, length};
}

}  // namespace tacto
