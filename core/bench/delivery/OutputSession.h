// OutputSession.h - the shared part of the sessions of a stimulator and a massager: takes one approved order at a time
// from the control loop, reports on each, and switches off at any moment, also if the loop falls silent.
//
// Thread-safety: idle() and forceOff() any thread. takeReport() and post() have one caller, the control loop; the
// protected rest has one caller, the device's thread (on the virtual clock, the bench).
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/Clock.h"
#include "core/base/SpscRing.h"
#include "core/bench/delivery/TrainReport.h"
#include "core/devices/Stimulator.h"
#include "core/safety/Heartbeat.h"

namespace tacto {

/// `Order` contains an approval, its `onset`, and what its report needs.
template <class Device, class Order>
class OutputSession {
public:
    OutputSession(const OutputSession&) = delete;
    OutputSession& operator=(const OutputSession&) = delete;

    /// False from post() until the report was made.
    [[nodiscard]] bool idle() const noexcept { return !busy_.load(std::memory_order_acquire); }
    [[nodiscard]] std::optional<TrainReport> takeReport() noexcept { return reports_.pop(); }

    /// Switches output off now, and again after a write in progress. The bench latches the gate first.
    void forceOff() noexcept {
        offs_.fetch_add(1, std::memory_order_acq_rel);
        device_.forceOff();
    }

    /// Returns how long the loop had been silent when that last switched the output off; 0: never. Any thread.
    [[nodiscard]] Instant silencedAfter() const noexcept {
        return Instant(silencedAfter_.load(std::memory_order_relaxed));
    }

    [[nodiscard]] const Device& device() const noexcept { return device_; }

protected:
    /// All arguments outlive the session. post() calls `wake`, so that a thread that waits for serve()'s due time
    /// checks again; may be empty.
    OutputSession(Device& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                  std::function<void()> wake)
        : device_(device), clock_(clock), gate_(gate), heartbeat_(heartbeat), wake_(std::move(wake)) {}
    ~OutputSession() = default;

    void post(Order&& order) noexcept {
        {
            const std::scoped_lock lock(mailbox_);
            pending_.emplace(std::move(order));
            busy_.store(true, std::memory_order_release);
        }
        if (wake_) wake_();
    }

    /// Returns the order if its onset has come; otherwise lowers `next` to that onset if it is earlier.
    [[nodiscard]] std::optional<Order> takeDue(Instant now, Instant& next) noexcept {
        const std::scoped_lock lock(mailbox_);
        if (pending_ && now >= pending_->onset) return std::exchange(pending_, std::nullopt);
        if (pending_) next = std::min(next, pending_->onset);
        return std::nullopt;
    }

    /// Calls `write` for an approved order, and switches off if the write failed. If the approval is void or the loop
    /// silent, writes nothing and returns nothing.
    template <class Approved, class Write>
    [[nodiscard]] std::optional<Result<void>> writeIfCurrent(const Approved& approved, Write write) noexcept {
        const auto offsBefore = offs_.load(std::memory_order_acquire);
        if (!gate_.isCurrent(approved) || !loopAlive()) return std::nullopt;
        Result<void> written = write();
        // A stop during the write may have reached the device before the write: switch off again. Do the same if
        // the process or the computer was halted during the write.
        if (!written || offs_.load(std::memory_order_acquire) != offsBefore || !loopAlive()) device_.forceOff();
        return written;
    }

    /// Returns false while the loop is silent, and then switches the device off. Reports this once, for the loop to
    /// find when it returns.
    [[nodiscard]] bool watchLoop(Instant now) noexcept {
        if (loopAlive()) {
            everServed_ = true;
            silenced_ = false;
            return true;
        }
        if (std::exchange(silenced_, true) || !everServed_) return false;
        device_.forceOff();
        const auto silence = heartbeat_.silence(clock_.elapsed()).value_or(Instant(0));
        silencedAfter_.store(silence.count(), std::memory_order_relaxed);
        TrainReport silent;
        silent.outcome = TrainOutcome::LoopSilent;
        silent.onset = silent.statusAt = now;
        silent.error = std::string_view("the control loop was silent for more than 100 ms");
        note(silent);
        return false;
    }

    /// Adds a report that belongs to no order.
    void note(const TrainReport& made) noexcept { reports_.push(made); }
    void report(const TrainReport& made) noexcept {
        reports_.push(made);
        busy_.store(false, std::memory_order_release);
    }

    Device& device_;
    const Clock& clock_;
    std::mutex mailbox_;  // guards pending_; held only to move an order

private:
    [[nodiscard]] bool loopAlive() const noexcept { return heartbeat_.alive(clock_.elapsed()); }

    const SafetyGate& gate_;
    const Heartbeat& heartbeat_;
    const std::function<void()> wake_;

    std::atomic<bool> busy_{false};
    std::atomic<std::uint64_t> offs_{0};  // counts forceOff() calls; a write during which it changes switches off again
    std::atomic<Instant::rep> silencedAfter_{0};
    std::optional<Order> pending_;
    SpscRing<TrainReport> reports_{16};

    // Used by the device thread only:
    bool silenced_ = false;    // true once the heartbeat was found dead and the output was switched off
    bool everServed_ = false;  // true once the heartbeat has been alive
};

// The only caller of a massager that replaces the electrodes: sends approved bursts at their onset, and switches the
// massager off if the control loop is silent.
//
// The session holds one burst at a time and is idle again once its report was made. serve() has one caller, the
// device's thread (on the virtual clock, the bench); post() has one, the control loop.

struct BurstOrder {
    ApprovedBurst burst;
    Instant onset;
    Seconds interval;
};

class MassagerSession : public OutputSession<Massager, BurstOrder> {
public:
    /// All arguments outlive the session. post() calls `wake`, which may be empty.
    MassagerSession(Massager& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                    std::function<void()> wake)
        : OutputSession(device, gate, heartbeat, clock, std::move(wake)) {}

    /// Hands over a burst to be sent at `onset`. The session must be idle(). The report keeps `interval`; its
    /// `amplitude` is the intensity, 0 to 1. A burst is not read back.
    void post(ApprovedBurst&& burst, Instant onset, Seconds interval) noexcept {
        OutputSession::post({std::move(burst), onset, interval});
    }

    /// Does what is due and returns the time of the next call.
    Instant serve(Instant now) noexcept;

private:
    void send(BurstOrder&& order, Instant now) noexcept;
};

}  // namespace tacto
