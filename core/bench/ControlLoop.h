// ControlLoop.h - one turn of the bench: read all sources → roughness and pressure → encode → gate → hand the train to
// the stimulator's session → commands → telemetry.
//
// The loop alone calls the gate and advances the interlock; any thread may stop the interlock. Its parts: the inbox
// for other threads' settings, the participant's word on levels, the order and its current presentation, the finger,
// the arming sequence, the judge of deliveries, the reading of |Z| and its age, the dispatch of trains, the exposure,
// the journal, and the taps of displays.
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
    /// A board's train is played this long after the board's onset, so that its way here, which is shorter, does not
    /// change the interval to the next; one that is kBoardLate off is not played (hazard H7).
    static constexpr Instant kBoardDelay = std::chrono::milliseconds(10);
    static constexpr Instant kBoardLate = std::chrono::milliseconds(100);

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
        BenchTap* tap = nullptr;                        ///< null if no view is open
        MassagerSession* massager = nullptr;            ///< null unless a massager replaces the stimulator
        const ReportingDevice* sensorReport = nullptr;  ///< the sensor, if it reports on itself
        /// A stop after the order to arm holds back all its check pulses and trains. Null: only the interlock does.
        StopCounter* stops = nullptr;
        std::optional<int> boardStream = {};  ///< the recorder's stream for the frames of a board that encodes
    };
    ControlLoop(Parts parts, std::unique_ptr<FingerInput> finger, std::unique_ptr<TrainPlanner> planner);

    /// Begins the check; the interlock must be in Checking. armed() returns the outcome.
    void arm(ArmCommand command);
    /// Hands in |Z| as the oscilloscope saw it in the check pulse, or why the pulse is not confirmed. Arming with
    /// `confirmByCapture` waits for this call. From another thread.
    void confirmCheck(const Result<Ohms>& seen) { inbox_.confirm(seen); }
    /// Returns nothing during the check, then success or the reason for failure. Can be taken once.
    [[nodiscard]] std::optional<Result<void>> armed() { return arming_.result(); }
    void drive(const DriveCommand& command) { inbox_.drive(command); }
    /// Presents at once a presentation that passed validate(), if the bench is armed and drives nothing. presented()
    /// returns nothing until the end, then the result, once.
    void present(Presentation presentation);
    [[nodiscard]] std::optional<Presented> presented() { return presentation_.result(); }
    /// See PresentationRun::beganAt().
    [[nodiscard]] std::optional<Instant> presentationBegan() { return presentation_.beganAt(); }
    /// The queue for the participant's statements about levels.
    [[nodiscard]] LevelRequests& levels() noexcept { return levels_; }
    void pauseOutput(bool paused) noexcept {
        dispatch_.pause(paused);
        if (paused) pausedSince_.store(true, std::memory_order_release);
    }
    /// Keeps the earlier flags, except the calibration flags if R was neither shown nor driving.
    void replaceFinger(std::unique_ptr<FingerInput> finger, RBefore before) {
        inbox_.finger({std::move(finger), before});
    }
    void replacePlanner(std::unique_ptr<TrainPlanner> planner) { inbox_.planner(std::move(planner)); }
    /// Also pushes the finger's samples (not frames, not trains) into `tap`, not owned, until null is passed. On return
    /// nothing is pushed into the earlier tap. From another thread.
    void listen(BenchTap* tap) { taps_.listen(tap); }
    /// Hands in the load that a capture showed during delivery. Judged only if the stimulator cannot read it back: an
    /// open load, or one outside its range, ends delivery. From another thread.
    void noteLoad(const SeenLoad& seen) { inbox_.load(seen); }
    /// Hands in the amplitude of a train as a capture showed it; judged at the next step. Any thread.
    void noteAmplitude(const SeenAmplitude& seen) { inbox_.amplitude(seen); }

    /// Makes one turn at `now`. Does not allocate in a steady state. If the previous turn was more than 100 ms ago
    /// (the process or the machine was halted), it first switches off and reports a fault; the first turn after the
    /// computer slept for more than a second disarms, as a stop does.
    void step(Instant now) noexcept;
    /// Records a state change of the interlock that came from outside; for a bench that will not step again.
    void noteState(Instant now) noexcept;

    [[nodiscard]] Telemetry telemetry() const noexcept;
    /// Number of trains refused so far. Any thread.
    [[nodiscard]] std::uint64_t refusals() const noexcept { return refusals_.load(std::memory_order_acquire); }
    /// Confirms that the owner of the output (a script, a window) looks after it until `until`. Later, driven output
    /// ends as by a stop: its owner may hang while the loop runs on (hazard H2). Any thread; does not block.
    void attend(Instant until) noexcept { order_.attend(until); }
    /// Returns why the loop itself ended the order: the computer slept, or the owner or the recording stood still.
    /// Empty if it did not. Any thread.
    [[nodiscard]] FixedText<159> endedBecause() const noexcept { return order_.endedBecause(); }
    /// Starts a new order, which the loop has not ended and which has delivered nothing yet.
    void beginOrder() noexcept;
    /// The largest exposure since beginOrder(), row by row, over every train. Any thread.
    [[nodiscard]] WorstExposure worstExposure() const noexcept { return exposure_.worst(); }
    /// See Telemetry::flags; for the profile that was set last. For use when no step runs any more.
    [[nodiscard]] RoughnessFlags flags() noexcept;
    /// Number of faults so far. Any thread.
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
    /// Shows the report. False if it only says that the loop was silent, which is a fault with nothing to judge.
    [[nodiscard]] bool hear(const TrainReport& report) noexcept;
    void judge(const TrainReport& report) noexcept;
    void judgeBurst(const TrainReport& report) noexcept;
    void judgeCheck(const TrainReport& report) noexcept;
    void updateCommand(Instant now) noexcept;
    void followBoard(Instant now) noexcept;
    void sendDue(Instant now) noexcept;
    void goOnPresenting(Instant now) noexcept;
    void renewReading(Instant now) noexcept;
    void refused(Instant now, std::string_view why) noexcept;
    void trip(FaultCause cause, std::string_view reason, Instant now) noexcept;
    /// `code`: the code of the error that reports the fault.
    void trip(FaultCause cause, std::string_view reason, Instant now, ErrorCode code) noexcept;
    void trip(const std::optional<LoopFault>& fault, Instant now) noexcept {
        if (fault) trip(fault->cause, fault->reason.view(), now);
    }
    void noteMeasured(Instant now) noexcept;
    void watchMassager(Instant now) noexcept;
    void publish(Instant now) noexcept;

    Parts parts_;
    std::atomic<bool> pausedSince_{false};  // true if a pause came since the presentation was requested
    std::atomic<std::uint64_t> refusals_{0};
    std::atomic<std::uint64_t> faults_{0};
    LoopInbox inbox_;
    LevelRequests levels_;
    PresentationRun presentation_;
    OwnerWatchdog order_;
    ExposureWatch exposure_;

    // Used by the loop only:
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
    Instant asleepSeen_{0};  // the clock's total sleep time when last checked
    DriveCommand drive_;
    InterlockState seenState_ = InterlockState::Disconnected;
    bool staleSeen_ = false;
    Instant boardUntil_{0};  // when the next train of the board is overdue
    StepTelemetry shown_;
    Latest<StepTelemetry> latest_;
};

}  // namespace tacto
