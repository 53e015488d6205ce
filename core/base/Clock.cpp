#include "core/base/Clock.h"

#include <ctime>
#include <string>

namespace tacto {

SteadyClock::SteadyClock() noexcept : start_(std::chrono::steady_clock::now()) {}

Instant SteadyClock::now() const noexcept {
    return std::chrono::duration_cast<Instant>(std::chrono::steady_clock::now() - start_);
}

Instant VirtualClock::now() const noexcept { return Instant(now_.load(std::memory_order_acquire)); }

void VirtualClock::advanceTo(Instant moment) noexcept {
    if (moment.count() > now_.load(std::memory_order_relaxed)) {
        now_.store(moment.count(), std::memory_order_release);
    }
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
