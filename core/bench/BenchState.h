// BenchState.h - the parts that a bench is made of, how they are put together, and in which order they end. Private to
// core/bench.
//
// Thread-safety: as Bench.h says of the calls that use it.
#pragma once

#include <atomic>

#include "core/bench/BenchNotes.h"
#include "core/bench/BenchTime.h"
#include "core/bench/arming/ArmingTerms.h"
#include "core/bench/arming/BenchLevels.h"
#include "core/bench/arming/StandingOrder.h"
#include "core/bench/delivery/BenchOutput.h"
#include "core/bench/sensing/ScopeSession.h"
#include "core/safety/Heartbeat.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/UnitRecord.h"
#include "core/session/SessionWriter.h"

namespace tacto {

struct Bench::State {
    explicit State(BenchConfig given);
    ~State();  ///< outputs off before the threads end, and after
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Puts the parts together; time passes from then on. Errors: as Bench::create().
    [[nodiscard]] Result<void> open();

    /// Disarmed first: see ControlLoop::mayPost().
    void off(const char* why) noexcept;
    /// Whether the bench may continue. Errors: Stopped; Device after a fault or when the sensor that drives failed; Io
    /// when the session cannot be written.
    [[nodiscard]] Result<void> health() const;
    void attend(Seconds within) noexcept {
        if (!config.watched || config.watched()) loop->attend(config.clock->now() + toInstant(within));
    }
    /// Waits until the unit has rested, where what it delivered before is not known. Errors: as health().
    [[nodiscard]] Result<void> rest();
    /// The way out of Faulted. Each cause is looked at again, here or before anything else can be delivered:
    ///   device lost, device fault, status missing   the device is asked, and must answer and deliver nothing
    ///   stale sensor, a failed sensor               the sensor is asked
    ///   loop silent                                 the loop must take its steps again
    ///   open, short, net charge, limit broken       the check pulse with which arming begins:
    ///   ControlLoop::judgeCheck();
    ///                                               a source that does not read back arms on the operator's word
    ///   internal error                              is never gone: the program is restarted
    /// Errors: NotArmed while the cause persists.
    [[nodiscard]] Result<void> leaveFault();
    /// A train driven by hand was refused since the caller last heard of one.
    [[nodiscard]] bool refusedByHand() const noexcept {
        return driving.load(std::memory_order_acquire) == DriveSource::Manual && loop->refusals() != refusalsSeen;
    }
    [[nodiscard]] Result<void> refusal();
    /// Whether something may be presented now. Errors: NotArmed; as health().
    [[nodiscard]] Result<void> readyToPresent() const;
    [[nodiscard]] Result<std::unique_ptr<FingerInput>> makeFinger(const Profile& profile);
    [[nodiscard]] std::unique_ptr<TrainPlanner> makePlanner(const Profile& profile);
    /// Null where there is no such device, or it reports nothing.
    [[nodiscard]] const ReportingDevice* reportingDevice(Role role) const noexcept;

    BenchConfig config;
    BenchCalibration calibration{config};
    std::unique_ptr<UnitRecord> record;  // the stimulator's record, where one is kept; outlives those that write to it
    BenchNotes notes;
    SafetyGate gate;
    Interlock interlock;
    Heartbeat heartbeat;
    std::unique_ptr<SessionRecorder> recorder;
    BenchOutput output{config.devices};
    ArmingTerms terms{config, output, calibration};
    std::unique_ptr<SensorSession> sensor;
    std::unique_ptr<ScopeSession> scope;
    std::unique_ptr<ControlLoop> loop;

    StandingOrder order;
    std::atomic<DriveSource> driving{DriveSource::Off};
    std::uint64_t refusalsSeen = 0;  // refusals that the caller of drive(), wait() and capture() has seen

    BenchTime time{*config.clock, output, order};  // The threads in it end first
    BenchLevels levels{config, output, calibration, terms, notes, gate, time, loop};

private:
    [[nodiscard]] Result<void> letReportsBeJudged();
    [[nodiscard]] Result<void> takeUpRecord();
    [[nodiscard]] Result<void> openRecorder(ControlLoop::Parts& parts);
    void openScope();
    void noteCapture(Capture& capture);
};

}  // namespace tacto
