// TrainDispatch.h - hands approved trains, bursts and check pulses to the output's session: checks that posting is
// still permitted, has the due order judged, and posts it.
//
// Thread-safety: pause() and paused() any thread; the rest has one caller, the control loop. Allocates only for an
// error.
#pragma once

#include <atomic>
#include <optional>
#include <utility>

#include "core/base/SpscRing.h"
#include "core/bench/LoopJournal.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/arming/StandingOrder.h"
#include "core/bench/delivery/DeliveryJudge.h"
#include "core/bench/delivery/ExposureWatch.h"
#include "core/bench/delivery/OutputSession.h"
#include "core/bench/delivery/PresentationRun.h"
#include "core/bench/delivery/StimulatorSession.h"

namespace tacto {

class TrainDispatch {
public:
    /// All of these outlive the dispatch. Either session or both may be null.
    struct Parts {
        SafetyGate& gate;
        Interlock& interlock;
        const OwnerWatchdog& order;
        const ArmingSequence& arming;
        const ArmedLoad& load;
        DeliveryJudge& judge;
        LoopJournal& journal;
        ExposureWatch& exposure;
        StimulatorSession* stimulator;
        MassagerSession* massager;
        Latest<StepTelemetry>& latest;  ///< the shown telemetry: a record may arrive before the loop's step ends
    };
    explicit TrainDispatch(Parts parts) noexcept : parts_(parts) {}

    void pause(bool paused) noexcept { paused_.store(paused, std::memory_order_release); }
    [[nodiscard]] bool paused() const noexcept { return paused_.load(std::memory_order_acquire); }

    /// True if an approved order may be posted; asked between approval and posting. A stop raises its counter and
    /// disarms before it voids approvals: earlier approvals are void, and later ones are held back here. The counter
    /// is needed if the stop came before the interlock had anything to disarm.
    [[nodiscard]] bool mayPost(bool isCheck) const noexcept;
    /// True if nothing is being written or read.
    [[nodiscard]] bool idle() const noexcept;
    void forceOff() noexcept;

    /// True if a train or burst is due within `ahead` and may be posted.
    [[nodiscard]] bool isDue(const TrainPlanner& planner, Instant now, Instant ahead) const noexcept;
    /// Moves the interlock to Delivering. Returns false if a stop came in between.
    [[nodiscard]] bool beginDelivery() noexcept;
    /// True once after beginDelivery() moved the interlock.
    [[nodiscard]] bool takeBegan() noexcept { return std::exchange(began_, false); }

    // These have the due order judged, post it and add it to `shown`. A stop in between posts nothing and is no error.
    // Errors: the refusal, as the planner's and the gate's.
    [[nodiscard]] Result<void> sendTrain(TrainPlanner& planner, Instant now, StepTelemetry& shown);
    [[nodiscard]] Result<void> sendBurst(TrainPlanner& planner, Instant now, const StepTelemetry& shown);
    [[nodiscard]] Result<void> sendPresented(PresentationRun& presentation, TrainPlanner& planner, Instant now,
                                             StepTelemetry& shown);
    /// Sends a check pulse that renews the reading of |Z|; the train follows once the pulse was judged.
    [[nodiscard]] Result<void> sendCheck(Instant now, StepTelemetry& shown);
    /// Posts the check pulse of arming, which is already approved.
    void postCheck(ApprovedTrain&& check, Instant onset, StepTelemetry& shown) noexcept {
        post(std::move(check), onset, std::nullopt, shown);
    }

    /// Takes the device's report on the last posted train.
    void reported(const TrainReport& report, StepTelemetry& shown) const noexcept;

private:
    /// `expected`: the amplitude that should come out, V or mA; nothing for a check pulse, which uses its own.
    void post(ApprovedTrain&& train, Instant onset, std::optional<double> expected, StepTelemetry& shown) noexcept;

    const Parts parts_;
    std::atomic<bool> paused_{false};
    [[nodiscard]] ProgrammedTrain& lastPosted(StepTelemetry& shown) const noexcept {
        return shown.programmed[(posted_ - 1) % shown.programmed.size()];
    }

    bool began_ = false;
    std::size_t posted_ = 0;  // number of posted trains, to index the ring of shown trains
};

}  // namespace tacto
