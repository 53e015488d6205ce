// Clock.h - the only source of time in core, apart from SystemTime; no other code asks the system for the time.
//
// A SteadyClock runs in real time. Only the control loop moves a VirtualClock, so that a session of two hours takes
// seconds and the same seed gives the same bytes. At a pace it takes its time, so that a person can follow.
//
// Thread-safety: any thread may call now() and asleep(). VirtualClock::advanceTo() and sleepFor() have one caller, the
// control loop.
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
    /// Time since this clock was made, without the time for which the computer slept. Never goes back.
    [[nodiscard]] virtual Instant now() const noexcept = 0;
    /// How long the computer has slept (was suspended) since this clock was made. now() does not include this time.
    [[nodiscard]] virtual Instant asleep() const noexcept { return Instant(0); }
    /// The sum of now() and asleep(). Heartbeats use it, so that the sleep of a computer counts as silence.
    [[nodiscard]] Instant elapsed() const noexcept { return now() + asleep(); }
    [[nodiscard]] virtual bool isVirtual() const noexcept = 0;
};

class SteadyClock final : public Clock {
public:
    SteadyClock() noexcept;
    [[nodiscard]] Instant now() const noexcept override;
    [[nodiscard]] Instant asleep() const noexcept override;  ///< accurate to a millisecond
    [[nodiscard]] bool isVirtual() const noexcept override { return false; }

private:
    const std::chrono::steady_clock::time_point start_;
    const Instant asleepAtStart_;
};

class VirtualClock final : public Clock {
public:
    /// `pace`: how many times faster than real time it passes, above 0; nothing: as fast as possible. Time
    /// stands still until the loop moves it on, for example while a question waits for its answer.
    explicit VirtualClock(std::optional<double> pace = std::nullopt) noexcept : pace_(pace) {}
    [[nodiscard]] Instant now() const noexcept override;
    [[nodiscard]] bool isVirtual() const noexcept override { return true; }
    [[nodiscard]] Instant asleep() const noexcept override;
    /// Moves time forward, at a pace after waiting for as long as that takes; ignores a moment in the past.
    void advanceTo(Instant moment) noexcept;
    /// Simulates a sleep of the computer for `duration`: now() does not change.
    void sleepFor(Instant duration) noexcept;

private:
    const std::optional<double> pace_;
    std::atomic<Instant::rep> now_{0};
    std::atomic<Instant::rep> asleep_{0};
};

/// Returns wall time as ISO 8601 UTC, such as "2026-11-20T14:03:05Z". Only for a session's header and names.
[[nodiscard]] std::string wallTimeUtc();
/// Reads a text of wallTimeUtc(). Returns nothing for any other text.
[[nodiscard]] std::optional<std::chrono::sys_seconds> wallTimeFrom(const std::string& utc);

// Time that other processes also see, for data that outlive the program; a Clock starts with the program.
//
// The second access to the system's time, besides Clock; core has no other.

class SystemTime {
public:
    virtual ~SystemTime() = default;
    /// Time since the computer was started, including the time for which it slept. Never goes back. Does not block.
    [[nodiscard]] virtual Instant sinceBoot() const noexcept = 0;
    /// Returns an identifier for this start of the computer; empty if the system has none.
    [[nodiscard]] virtual std::string boot() const = 0;
    /// Wall time, UTC. May jump. Does not block.
    [[nodiscard]] virtual std::chrono::sys_seconds wall() const noexcept = 0;

    /// Returns the computer's own time.
    [[nodiscard]] static const SystemTime& real() noexcept;
};

}  // namespace tacto
