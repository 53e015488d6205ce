// StimulatorSession.h - the only caller of a stimulator: writes approved trains at their onset, reads the device's
// status after each, and feeds the device's dead-man switch while the control loop is alive.
//
// The session holds one train at a time and is idle again once its report was made, so the next train waits until the
// status was read.
//
// Thread-safety: askHealth(), health(), trainEnd() and saysItDelivers() any thread; serve() only the device's thread
// (on the virtual clock, the bench); post() only the control loop. The rest as OutputSession.
#pragma once

#include "core/bench/delivery/OutputSession.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

/// Opens the record of a real stimulator, from which `gate` continues. `gate`, `clock` and `time` outlive the record.
/// Errors: as UnitRecord::open().
[[nodiscard]] Result<std::unique_ptr<UnitRecord>> takeUpUnit(const DeviceIdentity& stimulator,
                                                             const UnitFolders& folders, const Clock& clock,
                                                             const SystemTime& time, SafetyGate& gate);

struct TrainOrder {
    ApprovedTrain train;
    Instant onset;
    bool isCheck;
};

class StimulatorSession : public OutputSession<Stimulator, TrainOrder> {
public:
    /// All arguments outlive the session. post() calls `wake`, so that a thread that waits for serve()'s due time
    /// checks again; may be empty.
    StimulatorSession(Stimulator& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                      std::function<void()> wake)
        : OutputSession(device, gate, heartbeat, clock, std::move(wake)) {}

    /// The longest time from deliver() to the start of the train, because a device is programmed first.
    static constexpr Instant kBeginsWithin = std::chrono::milliseconds(200);
    /// Returns the latest time at which a train that is written at `onset` ends.
    [[nodiscard]] static Instant latestEnd(const PulseTrain& train, Instant onset) noexcept;
    /// Returns the latest end of the train in the session, as far as known: its status is due from then on. Any
    /// thread.
    [[nodiscard]] Instant trainEnd() const noexcept { return Instant(trainEnd_.load(std::memory_order_acquire)); }

    /// True if the device last answered that this train was still being delivered. Any thread.
    [[nodiscard]] bool saysItDelivers() const noexcept { return saysItDelivers_.load(std::memory_order_acquire); }

    /// Hands over a train to be written at `onset`. The session must be idle().
    void post(ApprovedTrain&& train, Instant onset, bool isCheck) noexcept;

    /// Asks for the device's health outside any train, to leave a fault. The next serve() answers.
    void askHealth() noexcept { healthAsked_.store(true, std::memory_order_release); }
    /// Returns nothing until answered; then success if the device answers and delivers nothing, else the failure.
    [[nodiscard]] std::optional<Result<void>> health();

    /// Returns the longest time between two keep-alives of a device with a dead-man switch, while the loop was alive.
    /// Any thread.
    [[nodiscard]] Instant longestKeepAliveGap() const noexcept {
        return Instant(longestGap_.load(std::memory_order_relaxed));
    }

    /// Does what is due and returns the time of the next call.
    Instant serve(Instant now) noexcept;

private:
    void deliver(TrainOrder&& order, Instant now) noexcept;
    void readStatus(Instant now) noexcept;
    void feedDeadMan(Instant now) noexcept;
    void answerHealth() noexcept;

    std::atomic<Instant::rep> trainEnd_{0};
    std::atomic<bool> saysItDelivers_{false};
    std::atomic<bool> healthAsked_{false};
    std::atomic<Instant::rep> longestGap_{0};
    std::optional<Result<void>> health_;  // guarded by mailbox_

    // Used by the device thread only:
    std::optional<TrainReport> awaitingStatus_;
    Instant statusDue_{0};
    Instant keepAliveDue_{0};
    std::optional<Instant> keptAliveAt_;
};

}  // namespace tacto
