// ControlLoop.h - one turn of the bench: read all sources → roughness and pressure → encode → gate → hand the
// train to the stimulator's session → commands → telemetry.
//
// It is the gate's only caller, and the only one to move the interlock forward; anybody may stop it.
//
// Thread-safety: step() has one caller. arm(), armed(), drive(), replaceFinger() and replacePlanner() may be called
// from another thread; the newest setting wins and takes effect in the next step. telemetry() any thread.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/base/Latest.h"
#include "core/bench/BenchTap.h"
#include "core/bench/CaptureLoad.h"
#include "core/bench/FingerInput.h"
#include "core/bench/MassagerSession.h"
#include "core/bench/StimulatorSession.h"
#include "core/bench/Telemetry.h"
#include "core/bench/TrainPlanner.h"
#include "core/bench/WorstExposure.h"
#include "core/devices/DeviceReport.h"
#include "core/safety/Interlock.h"
#include "core/safety/StopCounter.h"
#include "core/session/SessionRecorder.h"

namespace tacto {

struct DriveCommand {
    DriveSource source = DriveSource::Off;
    double roughness = 0;  ///< 0..1, Manual only
    double pressure = 0;
};

/// The second step of arming, prepared by the bench.
struct ArmCommand {
    GateSetup setup;
    ArmingEvidence evidence;  ///< its impedance is filled in from the check pulse
    /// |Z| of the declared load, where captures will tell what becomes of it and the stimulator does not: what a
    /// profile that holds charge or energy refers to.
    std::optional<Ohms> declared{};
    StopMark asked = {};  ///< when the operator gave the order to arm
    /// The source does not read back and an oscilloscope looks: the check pulse is delivered all the same, and armed is
    /// what confirmCheck() says.
    bool confirmByCapture = false;
};

/// What R was for before another profile takes over.
enum class RBefore {
    Shown,     ///< that it was not calibrated is a mark of the session
    Measuring  ///< for the references and scales of the new profile alone
};

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
        int frameStream;                ///< of the recorder, for roughness frames
        std::vector<int> sensorStreams;
        BenchTap* tap = nullptr;                        ///< may be null: no view is open
        MassagerSession* massager = nullptr;            ///< in place of a stimulator, else null
        const ReportingDevice* sensorReport = nullptr;  ///< the sensor, if it reports on itself
        /// A stop after the order to arm holds back every check pulse and train of it. Null: only the interlock does.
        StopCounter* stops = nullptr;
    };
    ControlLoop(Parts parts, std::unique_ptr<FingerInput> finger, std::unique_ptr<TrainPlanner> planner);

    /// Begins the check; the interlock is in Checking. armed() tells the end.
    void arm(ArmCommand command);
    /// What the oscilloscope showed of the check pulse: |Z|, or why it does not confirm it. Arming with
    /// `confirmByCapture` waits for it. From another thread.
    void confirmCheck(const Result<Ohms>& seen);
    /// Nothing while the check goes on, then success or why not. Taken once.
    [[nodiscard]] std::optional<Result<void>> armed();
    void drive(const DriveCommand& command);
    void pauseOutput(bool paused) noexcept { paused_.store(paused, std::memory_order_release); }
    /// The flags of the one before stay, but for those of calibration where R was not shown and drove nothing.
    void replaceFinger(std::unique_ptr<FingerInput> finger, RBefore before);
    void replacePlanner(std::unique_ptr<TrainPlanner> planner);
    /// Also pushes the finger's samples (not frames, not trains) into `tap`, not owned; null ends it, and on return
    /// nothing pushes into the one before. From another thread.
    void listen(BenchTap* tap);
    /// What a capture showed of the load while trains are delivered. Judged where the stimulator cannot read it back:
    /// a load outside its range, and an open one, end delivery. From another thread.
    void noteLoad(const SeenLoad& seen);
    /// How large a train came out, from a capture. Any thread; judged at the next step.
    void noteAmplitude(const SeenAmplitude& seen);

    /// One turn at `now`. Does not allocate in a steady state. A turn that comes more than 100 ms after the one before
    /// (the process was stopped, the machine stood still) finds a fault and switches off before anything else; one
    /// after the computer slept for more than a second disarms, and counts as a stop.
    void step(Instant now) noexcept;
    /// Records a change of the interlock that came from outside, for a bench that will not step again.
    void noteState(Instant now) noexcept;

    [[nodiscard]] Telemetry telemetry() const noexcept { return latest_.read(); }
    /// Trains refused so far. Any thread.
    [[nodiscard]] std::uint64_t refusals() const noexcept { return refusals_.load(std::memory_order_acquire); }
    /// Who ordered the output (a script, a window) is looking after it until then. Output that is driven for longer
    /// ends as by a stop: its owner may hang while the loop runs on (hazard H2). Any thread; does not block.
    void attend(Instant until) noexcept { attendedUntil_.store(until.count(), std::memory_order_release); }
    /// Why the loop itself ended the order: a sleep, an owner or a recording that stood still. Empty where it did not.
    /// Any thread.
    [[nodiscard]] FixedText<159> endedBecause() const noexcept;
    /// What comes from now on is another order, which the loop has not ended and which has delivered nothing yet.
    void beginOrder() noexcept;
    /// The largest exposure since then, row by row, over every train. Any thread.
    [[nodiscard]] WorstExposure worstExposure() const noexcept { return latestWorst_.read(); }
    /// See Telemetry::flags, as of the profile that was set last. For when no step runs any more.
    [[nodiscard]] RoughnessFlags flags() noexcept;
    /// Faults so far. Any thread.
    [[nodiscard]] std::uint64_t faults() const noexcept { return faults_.load(std::memory_order_acquire); }

private:
    struct Inbox {
        std::optional<ArmCommand> arm;
        std::optional<DriveCommand> drive;
        std::unique_ptr<FingerInput> finger;
        RBefore before = RBefore::Shown;
        std::unique_ptr<TrainPlanner> planner;
        std::optional<SeenLoad> load;
        std::optional<Result<Ohms>> confirmed;
        std::optional<SeenAmplitude> amplitude;
    };
    void beat(Instant now) noexcept;
    void wakeFromSilence(Instant now) noexcept;
    void wakeFromSleep(Instant now, Instant slept) noexcept;
    void watchOwner(Instant now) noexcept;
    void endOrder(Instant now, const char* kind, std::string_view why) noexcept;
    void outputsOff() noexcept;
    void takeCommands(Instant now) noexcept;
    void beginCheck(Instant now) noexcept;
    void armWithoutCheck(Instant now) noexcept;
    void armOnCapture(Instant now) noexcept;
    void armOnImpedance(const ArmingEvidence& evidence, Instant at) noexcept;
    void finishArming(Result<void> result) noexcept;
    void readFinger(Instant now) noexcept;
    void watchSensor(Instant now) noexcept;
    void noteLosses(Instant now) noexcept;
    void tapSamples(BenchTap& tap) noexcept;
    void serveListener() noexcept;
    void judgeReports() noexcept;
    void judge(const TrainReport& report) noexcept;
    void judgeBurst(const TrainReport& report) noexcept;
    void judgeImpedance(const TrainReport& report) noexcept;
    void judgeLoad(const SeenLoad& seen, Instant now) noexcept;
    /// True when what came out is not what was commanded: it is a fault.
    bool judgeReadBack(const TrainReport& report) noexcept;
    bool judgeAmplitude(const SeenAmplitude& seen, Instant now) noexcept;
    void updateImpedance(Ohms measured, Instant at) noexcept;
    void recordTrain(const TrainReport& report, const char* name) noexcept;
    void recordBurst(const TrainReport& report, const char* name) noexcept;
    [[nodiscard]] bool mayPost(bool isCheck) const noexcept;
    [[nodiscard]] bool stopped() const noexcept;
    void endArmingForStop() noexcept;
    void judgeCheck(const TrainReport& report) noexcept;
    void watchForSilence(Instant now) noexcept;
    void updateWish(Instant now) noexcept;
    void noteFlags(Instant now) noexcept;
    void takeFinger(std::unique_ptr<FingerInput> finger, RBefore before) noexcept;
    void sendTrain(Instant now) noexcept;
    void sendBurst(Instant now) noexcept;
    [[nodiscard]] bool beginDelivery() noexcept;
    /// `expected` is the amplitude that should come out, in V or mA: of a check pulse what it is told.
    void post(ApprovedTrain&& train, Instant onset, std::optional<double> expected) noexcept;
    void postCheck(ApprovedTrain&& check, Instant onset) noexcept { post(std::move(check), onset, std::nullopt); }
    void refused(Instant now, std::string_view why) noexcept;
    void trip(FaultCause cause, std::string_view reason, Instant now) noexcept;
    void publish(Instant now) noexcept;

    Parts parts_;
    std::unique_ptr<FingerInput> finger_;
    std::unique_ptr<TrainPlanner> planner_;
    RoughnessFlags flagsKept_;  // of fingers before this one, and what has driven the output
    std::atomic<bool> paused_{false};
    std::atomic<std::uint64_t> refusals_{0};
    std::atomic<std::uint64_t> faults_{0};
    std::atomic<Instant::rep> attendedUntil_{0};
    std::atomic<bool> anotherOrder_{false};  // and worst_ is of the one before

    std::mutex inboxMutex_;  // held to move a setting in or out
    Inbox inbox_;
    std::atomic<bool> inboxFull_{false};
    std::mutex listenMutex_;  // held to hand over the samples of one step
    BenchTap* listener_ = nullptr;
    std::atomic<bool> listening_{false};
    mutable std::mutex armedMutex_;
    std::optional<Result<void>> armedResult_;
    FixedText<159> endedBecause_;  // guarded by armedMutex_

    // The loop's own:
    std::optional<ArmCommand> arming_;
    bool checkPosted_ = false;               // of arming_
    bool checkRead_ = false;                 // of arming_: the device has reported, the capture has not come
    std::optional<Result<Ohms>> confirmed_;  // of arming_: what the capture showed
    Instant asleepSeen_{0};                  // of the clock, when it was looked at last after a silence
    StopMark order_;                         // for which the output was armed, or is being armed
    std::size_t told_ = 0;                   // trains, for the ring of shown_
    double expected_ = NAN;  // amplitude of the train that was posted last, V or mA, as it should come out
    DriveCommand drive_;
    InterlockState seenState_ = InterlockState::Disconnected;
    bool staleSeen_ = false;
    std::uint64_t sensorFailuresSeen_ = 0;
    std::uint64_t lossesNoted_ = 0;
    Instant lossesDue_{0};  // not before then
    std::optional<Ohms> impedance_;
    Instant impedanceAt_{0};
    Instant armedAt_{0};
    Ohms impedanceHigh_{0};  // of the load that was declared when arming
    Telemetry shown_;
    std::vector<ExposureRow> exposure_;
    Instant exposureAt_{0};
    WorstExposure worst_;
    Latest<WorstExposure> latestWorst_;
    Latest<Telemetry> latest_;
};

}  // namespace tacto
