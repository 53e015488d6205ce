// StimulatorSession.h - the only caller of a stimulator: writes approved trains at their onset, reads the
// device's status after each, keeps its dead-man switch fed while the control loop is alive.
//
// One train is in the session at a time: it is idle again when its report was made, so a status that was
// not read holds back the next train.
//
// Thread-safety: askHealth(), health(), trainEnd() and saysItDelivers() any thread; serve() has one caller, the
// device's thread (on the virtual clock, the bench); post() has one, the control loop. The rest as OutputSession.
#pragma once

#include "core/bench/delivery/OutputSession.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

/// The record of a real stimulator, from which `gate` continues. Both, `clock` and `time` outlive the use of it.
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
    /// All arguments outlive the session. `wake` is called after post(), so that a thread waiting for serve()'s
    /// due time looks again; may be empty.
    StimulatorSession(Stimulator& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                      std::function<void()> wake)
        : OutputSession(device, gate, heartbeat, clock, std::move(wake)) {}

    /// How long deliver() may take until the train begins: a device is programmed first.
    static constexpr Instant kBeginsWithin = std::chrono::milliseconds(200);
    /// The latest time at which a train that is to be written at `onset` has ended.
    [[nodiscard]] static Instant latestEnd(const PulseTrain& train, Instant onset) noexcept;
    /// The latest end of the train that is in the session, as far as it is known: its status is due from then on. Any
    /// thread.
    [[nodiscard]] Instant trainEnd() const noexcept { return Instant(trainEnd_.load(std::memory_order_acquire)); }

    /// The last answer about that train was that it is still being delivered. Any thread.
    [[nodiscard]] bool saysItDelivers() const noexcept { return saysItDelivers_.load(std::memory_order_acquire); }

    /// Hands over a train to be written at `onset`. The session must be idle().
    void post(ApprovedTrain&& train, Instant onset, bool isCheck) noexcept;

    /// Asks the device how it is, outside any train: for leaving a fault. Answered by the next serve().
    void askHealth() noexcept { healthAsked_.store(true, std::memory_order_release); }
    /// Nothing while unanswered; then success when the device answers and delivers nothing, else why it failed.
    [[nodiscard]] std::optional<Result<void>> health();

    /// The longest time between two keep-alives of a device with a dead-man switch, while the loop was alive. Any
    /// thread.
    [[nodiscard]] Instant longestKeepAliveGap() const noexcept {
        return Instant(longestGap_.load(std::memory_order_relaxed));
    }

    /// Does what is due and returns when it wants to be called again.
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

    // The device thread's own:
    std::optional<TrainReport> awaitingStatus_;
    Instant statusDue_{0};
    Instant keepAliveDue_{0};
    std::optional<Instant> keptAliveAt_;
};

}  // namespace tacto
