// Heartbeat.h - tells device threads whether the control loop still runs (H2).
//
// The loop beats once per turn; a device thread asks before every write and while a device keeps itself on. After
// 100 ms of silence alive() returns false: device threads force their output off and no longer hold off dead-man
// switches, so a hung program ends with its output off. alive() is also false before the first beat.
//
// After a silence the heartbeat stays dead. When a whole process was halted, any thread may wake first. So a late
// beat is refused: the loop switches off, voids all approvals, and only then calls revive().
//
// All times are Clock::elapsed(), which includes the time while the computer slept.
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

    /// Returns false, and alive() stays false, if the last beat was more than kSilence ago. The first beat, also after
    /// end(), is never late. One caller, the loop.
    bool beat(Instant now) noexcept {
        if (gate::firstBroken(kBeatConditions, Pulse{last_.load(std::memory_order_relaxed), now})) return false;
        last_.store(now.count(), std::memory_order_release);
        return true;
    }
    /// Beats again after the loop has switched the outputs off and voided every approval.
    void revive(Instant now) noexcept { last_.store(now.count(), std::memory_order_release); }
    /// Ends the heartbeat on purpose: alive() is false until the next beat.
    void end() noexcept { last_.store(kNoBeat, std::memory_order_release); }
    [[nodiscard]] bool alive(Instant now) const noexcept {
        return !gate::firstBroken(kAliveConditions, Pulse{last_.load(std::memory_order_acquire), now});
    }
    /// Returns the time since the last beat; nothing before the first beat and after end().
    [[nodiscard]] std::optional<Instant> silence(Instant now) const noexcept {
        const auto last = last_.load(std::memory_order_acquire);
        if (last == kNoBeat) return std::nullopt;
        return now - Instant(last);
    }

private:
    static constexpr Instant::rep kNoBeat = std::numeric_limits<Instant::rep>::min();
    /// The time of the last beat, and now.
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
