// Clock.h - the only source of time in core; nothing else asks the system.
//
// A SteadyClock runs in real time; a VirtualClock moves only when the control loop moves it, so that a
// two-hour session takes seconds and the same seed gives the same bytes.
//
// Thread-safety: now() and asleep() may be called from any thread. VirtualClock::advanceTo() and sleepFor() have one
// caller, the control loop.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "core/base/Units.h"

namespace tacto {

class Clock {
public:
    virtual ~Clock() = default;
    /// Time since this clock was made, as long as the computer was awake. Never goes back.
    [[nodiscard]] virtual Instant now() const noexcept = 0;
    /// How long the computer has slept (suspended) since this clock was made: now() does not count that.
    [[nodiscard]] virtual Instant asleep() const noexcept { return Instant(0); }
    /// now() and asleep() together: what a heartbeat is timed by, so that a computer that slept counts as silence.
    [[nodiscard]] Instant elapsed() const noexcept { return now() + asleep(); }
    [[nodiscard]] virtual bool isVirtual() const noexcept = 0;
};

class SteadyClock final : public Clock {
public:
    SteadyClock() noexcept;
    [[nodiscard]] Instant now() const noexcept override;
    [[nodiscard]] Instant asleep() const noexcept override;  ///< right to a millisecond
    [[nodiscard]] bool isVirtual() const noexcept override { return false; }

private:
    const std::chrono::steady_clock::time_point start_;
    const Instant asleepAtStart_;
};

class VirtualClock final : public Clock {
public:
    [[nodiscard]] Instant now() const noexcept override;
    [[nodiscard]] bool isVirtual() const noexcept override { return true; }
    [[nodiscard]] Instant asleep() const noexcept override;
    /// Moves time forward; a moment already past is ignored.
    void advanceTo(Instant moment) noexcept;
    /// The computer sleeps for `duration`: now() stands still.
    void sleepFor(Instant duration) noexcept;

private:
    std::atomic<Instant::rep> now_{0};
    std::atomic<Instant::rep> asleep_{0};
};

/// Wall time as ISO 8601 UTC, e.g. "2026-11-20T14:03:05Z". For a session's header and names, nothing else.
[[nodiscard]] std::string wallTimeUtc();
/// Reads what wallTimeUtc() wrote. Returns nothing for any other text.
[[nodiscard]] std::optional<std::chrono::sys_seconds> wallTimeFrom(const std::string& utc);

// Time as other processes read it too, for what outlives the program. A Clock begins with the program.
//
// The second seam to the system's time beside Clock: nothing else in core asks for it.

class SystemTime {
public:
    virtual ~SystemTime() = default;
    /// The time since the computer was started, including the time for which it slept. Never goes back. Does not block.
    [[nodiscard]] virtual Instant sinceBoot() const noexcept = 0;
    /// Names this start of the computer; empty where the system does not tell.
    [[nodiscard]] virtual std::string boot() const = 0;
    /// Wall time, UTC. May jump. Does not block.
    [[nodiscard]] virtual std::chrono::sys_seconds wall() const noexcept = 0;

    /// The system's own.
    [[nodiscard]] static const SystemTime& real() noexcept;
};

}  // namespace tacto
