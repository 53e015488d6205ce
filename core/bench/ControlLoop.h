// ControlLoop.h - one turn of the bench: read all sources → roughness and pressure → encode → gate → hand the
// train to the stimulator's session → commands → telemetry.
//
// It is the gate's only caller, and the only one to move the interlock forward; any thread may stop it. Its parts: the
// inbox of what other threads set, the participant's word on levels, the order and the presentation that it carries
// out, the finger, the arming sequence, the judge of what was delivered, the reading of |Z| and its age, the dispatch
// of trains, the exposure, the journal, and the taps of displays.
//
// Thread-safety: step() has one caller. arm(), armed(), drive(), replaceFinger() and replacePlanner() may be called
// from another thread; the newest setting wins and takes effect in the next step. telemetry() any thread.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/SpscRing.h"
#include "core/bench/LoopInbox.h"
#include "core/bench/LoopJournal.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/arming/StandingOrder.h"
#include "core/bench/delivery/DeliveryJudge.h"
#include "core/bench/delivery/ExposureWatch.h"
#include "core/bench/delivery/OutputSession.h"
#include "core/bench/delivery/PresentationRun.h"
#include "core/bench/delivery/StimulatorSession.h"
#include "core/bench/delivery/TrainDispatch.h"
#include "core/bench/sensing/FingerWatch.h"
#include "core/bench/sensing/MassagerWatch.h"

namespace tacto {

class ControlLoop {
public:
    /// The time from one step to the next.
    static constexpr Instant kPeriod = std::chrono::milliseconds(5);

    struct Parts {
        const Clock& clock;
        SafetyGate& gate;
        Interlock& interlock;
        Heartbeat& heartbeat;
        OutputMode mode;
        StimulatorSession* stimulator;  ///< may be null
        SessionRecorder* recorder;      ///< may be null
        int frameStream;                ///< the recorder's stream for roughness frames
        std::vector<int> sensorStreams;
        BenchTap* tap = nullptr;                        ///< may be null: no view is open
        MassagerSession* massager = nullptr;            ///< null unless a massager takes the place of the stimulator
        const ReportingDevice* sensorReport = nullptr;  ///< the sensor, if it reports on itself
        /// A stop after the order to arm holds back every check pulse and train of it. Null: only the interlock does.
        StopCounter* stops = nullptr;
    };
    ControlLoop(Parts parts, std::unique_ptr<FingerInput> finger, std::unique_ptr<TrainPlanner> planner);

    /// Begins the check; the interlock is in Checking. armed() reports the end.
    void arm(ArmCommand command);
    /// Hands in the oscilloscope's view of the check pulse: |Z|, or why it does not confirm it. Arming with
    /// `confirmByCapture` waits for it. From another thread.
    void confirmCheck(const Result<Ohms>& seen) { inbox_.confirm(seen); }
    /// Nothing while the check is going on, then success or why it failed. Taken once.
    [[nodiscard]] std::optional<Result<void>> armed() { return arming_.result(); }
    void drive(const DriveCommand& command) { inbox_.drive(command); }
    /// Presents at once what has passed validate(), if the bench is armed and drives nothing. presented() tells the
    /// end: nothing before it. Taken once.
    void present(Presentation presentation);
    [[nodiscard]] std::optional<Presented> presented() { return presentation_.result(); }
    /// As PresentationRun::beganAt().
    [[nodiscard]] std::optional<Instant> presentationBegan() { return presentation_.beganAt(); }
    /// Takes the participant's word on levels.
    [[nodiscard]] LevelRequests& levels() noexcept { return levels_; }
    void pauseOutput(bool paused) noexcept {
        dispatch_.pause(paused);
        if (paused) pausedSince_.store(true, std::memory_order_release);
    }
    /// The earlier flags stay, except those of calibration where R was not shown and drove nothing.
    void replaceFinger(std::unique_ptr<FingerInput> finger, RBefore before) {
        inbox_.finger({std::move(finger), before});
    }
    void replacePlanner(std::unique_ptr<TrainPlanner> planner) { inbox_.planner(std::move(planner)); }
    /// Also pushes the finger's samples (not frames, not trains) into `tap`, not owned; null ends it, and on return
    /// nothing pushes into the one before. From another thread.
    void listen(BenchTap* tap) { taps_.listen(tap); }
    /// Hands in a capture's view of the load while trains are delivered. Judged where the stimulator cannot read it
    /// back: a load outside its range, and an open one, end delivery. From another thread.
    void noteLoad(const SeenLoad& seen) { inbox_.load(seen); }
    /// How large a train came out, from a capture. Any thread; judged at the next step.
    void noteAmplitude(const SeenAmplitude& seen) { inbox_.amplitude(seen); }

    /// Makes one turn at `now`. Does not allocate in a steady state. A turn that comes more than 100 ms after the one
    /// before (the process was stopped, the machine stood still) finds a fault and switches off before anything else; a
    /// turn after the computer slept for more than a second disarms, and counts as a stop.
    void step(Instant now) noexcept;
    /// Records a change of the interlock that came from outside, for a bench that will not step again.
    void noteState(Instant now) noexcept;

    [[nodiscard]] Telemetry telemetry() const noexcept;
    /// Trains refused so far. Any thread.
    [[nodiscard]] std::uint64_t refusals() const noexcept { return refusals_.load(std::memory_order_acquire); }
    /// The owner of the output (a script, a window) looks after it until then. Output that is driven for longer ends as
    /// by a stop: its owner may hang while the loop runs on (hazard H2). Any thread; does not block.
    void attend(Instant until) noexcept { order_.attend(until); }
    /// Why the loop itself ended the order: a sleep, or an owner or a recording that stood still. Empty where it did
    /// not. Any thread.
    [[nodiscard]] FixedText<159> endedBecause() const noexcept { return order_.endedBecause(); }
    /// From now on another order holds, which the loop has not ended and which has delivered nothing yet.
    void beginOrder() noexcept;
    /// The largest exposure since then, row by row, over every train. Any thread.
    [[nodiscard]] WorstExposure worstExposure() const noexcept { return exposure_.worst(); }
    /// See Telemetry::flags, as of the profile that was set last. For when no step runs any more.
    [[nodiscard]] RoughnessFlags flags() noexcept;
    /// Faults so far. Any thread.
    [[nodiscard]] std::uint64_t faults() const noexcept { return faults_.load(std::memory_order_acquire); }

private:
    void beat(Instant now) noexcept;
    void wakeFromSilence(Instant now) noexcept;
    void wakeFromSleep(Instant now, Instant slept) noexcept;
    void watchOwner(Instant now) noexcept;
    void endOrder(Instant now, const char* kind, std::string_view why) noexcept;
    void takeCommands(Instant now) noexcept;
    void postCheckOfArming(Instant now) noexcept;
    void judgeReports() noexcept;
    /// Shows the report. False for one that only says that the loop was silent, which is a fault and nothing to judge.
    [[nodiscard]] bool hear(const TrainReport& report) noexcept;
    void judge(const TrainReport& report) noexcept;
    void judgeBurst(const TrainReport& report) noexcept;
    void judgeCheck(const TrainReport& report) noexcept;
    void updateCommand(Instant now) noexcept;
    void sendDue(Instant now) noexcept;
    void goOnPresenting(Instant now) noexcept;
    void renewReading(Instant now) noexcept;
    void refused(Instant now, std::string_view why) noexcept;
    void trip(FaultCause cause, std::string_view reason, Instant now) noexcept;
    /// `code`: of the error that tells of the fault.
    void trip(FaultCause cause, std::string_view reason, Instant now, ErrorCode code) noexcept;
    void trip(const std::optional<LoopFault>& fault, Instant now) noexcept {
        if (fault) trip(fault->cause, fault->reason.view(), now);
    }
    void noteMeasured(Instant now) noexcept;
    void watchMassager(Instant now) noexcept;
    void publish(Instant now) noexcept;

    Parts parts_;
    std::atomic<bool> pausedSince_{false};  // the presentation was asked for
    std::atomic<std::uint64_t> refusals_{0};
    std::atomic<std::uint64_t> faults_{0};
    LoopInbox inbox_;
    LevelRequests levels_;
    PresentationRun presentation_;
    OwnerWatchdog order_;
    ExposureWatch exposure_;

    // The loop's own:
    std::unique_ptr<TrainPlanner> planner_;
    ArmedLoad load_;
    ArmingSequence arming_;
    DeliveryJudge judge_;
    LoopJournal journal_;
    SampleTaps taps_;
    FingerWatch finger_;
    ReadingWatch reading_;
    MassagerWatch rests_;
    TrainDispatch dispatch_;
    Instant asleepSeen_{0};  // what the clock said at the last look after a silence
    DriveCommand drive_;
    InterlockState seenState_ = InterlockState::Disconnected;
    bool staleSeen_ = false;
    StepTelemetry shown_;
    Latest<StepTelemetry> latest_;
};

}  // namespace tacto
