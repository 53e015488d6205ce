#include "core/base/Clock.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <thread>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

Instant read(clockid_t clock) noexcept {
    std::timespec at{};
    clock_gettime(clock, &at);
    return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
}

/// CLOCK_BOOTTIME counts while the computer sleeps; CLOCK_MONOTONIC (the steady clock) does not. If the thread was
/// paused between the two readings, they are taken again, since the pause would look like sleep.
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
    const auto ahead = moment.count() - now_.load(std::memory_order_relaxed);
    if (ahead <= 0) return;
    if (pace_) std::this_thread::sleep_for(Seconds(Instant(ahead)) / *pace_);
    now_.store(moment.count(), std::memory_order_release);
}

Instant VirtualClock::asleep() const noexcept { return Instant(asleep_.load(std::memory_order_acquire)); }

void VirtualClock::sleepFor(Instant duration) noexcept {
    if (duration.count() > 0) asleep_.fetch_add(duration.count(), std::memory_order_acq_rel);
}

namespace {

std::string wallText(std::time_t at) {
    std::tm parts{};
    gmtime_r(&at, &parts);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                       parts.tm_hour, parts.tm_min, parts.tm_sec);
}

}  // namespace

std::string wallTimeUtc() { return wallText(std::time(nullptr)); }

std::optional<std::chrono::sys_seconds> wallTimeFrom(const std::string& utc) {
    if (utc.size() != std::string_view("2026-11-21T09:30:00Z").size()) return std::nullopt;
    const auto number = [&](std::size_t from, std::size_t digits) {
        return parseWhole<int>(std::string_view(utc).substr(from, digits)).value_or(0);
    };
    std::tm parts{};
    parts.tm_year = number(0, 4) - 1900;
    parts.tm_mon = number(5, 2) - 1;
    parts.tm_mday = number(8, 2);
    parts.tm_hour = number(11, 2);
    parts.tm_min = number(14, 2);
    parts.tm_sec = number(17, 2);
    const auto at = timegm(&parts);
    if (wallText(at) != utc) return std::nullopt;  // an impossible day, or other text between the numbers
    return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::from_time_t(at));
}

namespace {

class RealTime final : public SystemTime {
public:
    [[nodiscard]] Instant sinceBoot() const noexcept override {
        std::timespec at{};
        clock_gettime(CLOCK_BOOTTIME, &at);
        return std::chrono::seconds(at.tv_sec) + std::chrono::nanoseconds(at.tv_nsec);
    }
    [[nodiscard]] std::string boot() const override {
        std::ifstream in("/proc/sys/kernel/random/boot_id");
        std::string id;
        std::getline(in, id);
        return id;
    }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override {
        return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    }
};

}  // namespace

const SystemTime& SystemTime::real() noexcept {
    static const RealTime time;
    return time;
}

}  // namespace tacto
