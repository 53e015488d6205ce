// MassagerSession.h - the only caller of a massager that stands in for the electrodes: sends approved bursts at their
// onset, and switches it off when the control loop is silent.
//
// One burst is in the session at a time: it is idle again when its report was made.
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench). post(), idle() and
// takeReport() have one caller, the control loop. forceOff() any thread.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "core/base/Clock.h"
#include "core/base/SpscRing.h"
#include "core/bench/TrainReport.h"
#include "core/devices/Massager.h"
#include "core/safety/Heartbeat.h"

namespace tacto {

class MassagerSession {
public:
    /// All arguments outlive the session. `wake` is called after post(); may be empty.
    MassagerSession(Massager& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                    std::function<void()> wake);

    [[nodiscard]] bool idle() const noexcept { return !busy_.load(std::memory_order_acquire); }
    /// Hands over a burst to be sent at `onset`. The session must be idle(). `interval` is for the report.
    void post(ApprovedBurst&& burst, Instant onset, Seconds interval) noexcept;
    /// A burst's `amplitude` is its intensity, 0 to 1; nothing of it is read back.
    [[nodiscard]] std::optional<TrainReport> takeReport() noexcept { return reports_.pop(); }

    /// Off now, and again after a write that is in flight. The bench latches the gate first.
    void forceOff() noexcept;

    /// Does what is due and returns when it wants to be called again.
    Instant serve(Instant now) noexcept;

private:
    struct Pending {
        ApprovedBurst burst;
        Instant onset;
        Seconds interval;
    };
    void send(Pending&& pending, Instant now) noexcept;
    void watchLoop(Instant now) noexcept;

    Massager& device_;
    const SafetyGate& gate_;
    const Heartbeat& heartbeat_;
    const Clock& clock_;
    const std::function<void()> wake_;

    std::atomic<bool> busy_{false};
    std::atomic<std::uint64_t> offs_{0};  // forceOff() calls; a write that saw one pass switches off again
    std::mutex mailbox_;                  // guards pending_; held for a move only
    std::optional<Pending> pending_;
    SpscRing<TrainReport> reports_{16};

    // The device thread's own:
    bool silenced_ = false;    // the heartbeat was found dead and the output switched off
    bool everServed_ = false;  // the heartbeat was once alive
};

}  // namespace tacto
