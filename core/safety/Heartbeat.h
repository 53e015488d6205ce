// Heartbeat.h - tells device threads whether the control loop still runs (H2).
//
// The loop beats once per turn; a device thread asks before every write and while a device holds itself
// on. After 100 ms of silence the answer is no: device threads force their output off and stop holding off dead-man
// switches, so a hung program ends in silence. Not alive before the first beat.
//
// A heart that stood still stays dead. After a standstill of the whole process any thread may wake first,
// so a beat that comes too late is refused: the loop switches off, voids what was approved, and only then calls
// revive().
//
// All moments are Clock::elapsed(), which counts the time for which the computer slept.
//
// Thread-safety: any thread may call anything; lock-free.
#pragma once

#include <atomic>
#include <limits>
#include <optional>

#include "core/base/Units.h"
#include "core/safety/Rules.h"

namespace tacto {

class Heartbeat {
public:
    static constexpr Instant kSilence = std::chrono::milliseconds(100);

    /// False, and nothing is alive, when the last beat was more than kSilence ago. The first beat, and the first after
    /// end(), is never late. One caller, the loop.
    bool beat(Instant now) noexcept {
        if (gate::firstBroken(kBeatConditions, Pulse{last_.load(std::memory_order_relaxed), now})) return false;
        last_.store(now.count(), std::memory_order_release);
        return true;
    }
    /// The loop has switched the outputs off and voided every approval: it beats again.
    void revive(Instant now) noexcept { last_.store(now.count(), std::memory_order_release); }
    /// The loop ends on purpose: not alive until the next beat.
    void end() noexcept { last_.store(kNoBeat, std::memory_order_release); }
    [[nodiscard]] bool alive(Instant now) const noexcept {
        return !gate::firstBroken(kAliveConditions, Pulse{last_.load(std::memory_order_acquire), now});
    }
    /// The time since the last beat; nothing before the first and after end().
    [[nodiscard]] std::optional<Instant> silence(Instant now) const noexcept {
        const auto last = last_.load(std::memory_order_acquire);
        if (last == kNoBeat) return std::nullopt;
        return now - Instant(last);
    }

private:
    static constexpr Instant::rep kNoBeat = std::numeric_limits<Instant::rep>::min();
    /// The last beat, and now.
    struct Pulse {
        Instant::rep last;
        Instant now;
        [[nodiscard]] bool silent() const noexcept { return now.count() - last > kSilence.count(); }
    };
    static constexpr gate::Condition<Pulse> kBeatConditions[] = {
        {gate::HeartLate, [](auto& p) noexcept { return p.last != kNoBeat && p.silent(); }},
    };
    static constexpr gate::Condition<Pulse> kAliveConditions[] = {
        {gate::HeartNever, [](auto& p) noexcept { return p.last == kNoBeat; }},
        {gate::HeartSilent, [](auto& p) noexcept { return p.silent(); }},
    };
    std::atomic<Instant::rep> last_{kNoBeat};
};

}  // namespace tacto
