#include "core/base/Clock.h"

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <locale>
#include <sstream>
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

namespace {

constexpr const char* kWallFormat = "%Y-%m-%dT%H:%M:%SZ";

std::string wallText(std::time_t at) {
    std::tm parts{};
    gmtime_r(&at, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof text, kWallFormat, &parts)};
}

}  // namespace

std::string wallTimeUtc() { return wallText(std::time(nullptr)); }

std::optional<std::chrono::sys_seconds> wallTimeFrom(const std::string& utc) {
    std::tm parts{};
    std::istringstream text(utc);
    text.imbue(std::locale::classic());
    text >> std::get_time(&parts, kWallFormat);
    const auto at = timegm(&parts);
    if (!text || wallText(at) != utc) return std::nullopt;  // get_time() is lenient
    return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::from_time_t(at));
}

}  // namespace tacto
