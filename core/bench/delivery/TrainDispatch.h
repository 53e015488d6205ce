// TrainDispatch.h - hands approved trains, bursts and check pulses to the output's session: asks whether one may still
// be posted, has the due one judged, and posts it.
//
// Thread-safety: pause() and paused() any thread; the rest has one caller, the control loop. Does not allocate but for
// an error.
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
    /// All of these outlive the dispatch. One or both of the sessions may be null.
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
        Latest<StepTelemetry>& latest;  ///< the shown telemetry: a record may come before the loop's step has ended
    };
    explicit TrainDispatch(Parts parts) noexcept : parts_(parts) {}

    void pause(bool paused) noexcept { paused_.store(paused, std::memory_order_release); }
    [[nodiscard]] bool paused() const noexcept { return paused_.load(std::memory_order_acquire); }

    /// Asked after an approval was granted and before it is posted. A stop raises its counter and disarms before it
    /// voids approvals, so an approval made after the voiding is held back here, and one made before it is void. The
    /// counter counts where the stop came before the interlock had anything to disarm.
    [[nodiscard]] bool mayPost(bool isCheck) const noexcept;
    /// Whether nothing is being written or read.
    [[nodiscard]] bool idle() const noexcept;
    void forceOff() noexcept;

    /// Whether a train or a burst is due within `ahead`, and may be posted.
    [[nodiscard]] bool isDue(const TrainPlanner& planner, Instant now, Instant ahead) const noexcept;
    /// Moves the interlock to Delivering. False when a stop came in between.
    [[nodiscard]] bool beginDelivery() noexcept;
    /// True once after beginDelivery() moved the interlock.
    [[nodiscard]] bool takeBegan() noexcept { return std::exchange(began_, false); }

    // Has what is due judged and posts it into `shown`'s ring too. A stop in between posts nothing and is not an error.
    // Errors: the refusal, as the planner's and the gate's.
    [[nodiscard]] Result<void> sendTrain(TrainPlanner& planner, Instant now, StepTelemetry& shown);
    [[nodiscard]] Result<void> sendBurst(TrainPlanner& planner, Instant now, const StepTelemetry& shown);
    [[nodiscard]] Result<void> sendPresented(PresentationRun& presentation, TrainPlanner& planner, Instant now,
                                             StepTelemetry& shown);
    /// A check pulse that renews the reading of |Z|; the train follows when it was judged.
    [[nodiscard]] Result<void> sendCheck(Instant now, StepTelemetry& shown);
    /// The check pulse of arming, already approved.
    void postCheck(ApprovedTrain&& check, Instant onset, StepTelemetry& shown) noexcept {
        post(std::move(check), onset, std::nullopt, shown);
    }

    /// The device's report on the train that was posted last.
    void reported(const TrainReport& report, StepTelemetry& shown) const noexcept;

private:
    /// `expected` is the amplitude that should come out, in V or mA; nothing for a check pulse: what is programmed.
    void post(ApprovedTrain&& train, Instant onset, std::optional<double> expected, StepTelemetry& shown) noexcept;

    const Parts parts_;
    std::atomic<bool> paused_{false};
    [[nodiscard]] ProgrammedTrain& lastPosted(StepTelemetry& shown) const noexcept {
        return shown.programmed[(posted_ - 1) % shown.programmed.size()];
    }

    bool began_ = false;
    std::size_t posted_ = 0;  // trains, for the ring of what is shown
};

}  // namespace tacto
