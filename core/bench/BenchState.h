// BenchState.h - the parts of a bench, how they are put together, and in which order they end. Private to core/bench.
//
// Thread-safety: as Bench.h states for the calls that use each part.
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
    ~State();  ///< switches outputs off before the threads end, and again afterwards
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Puts the parts together; from then on time passes. Errors: as Bench::create().
    [[nodiscard]] Result<void> open();

    /// Switches all output off. Disarms first: see TrainDispatch::mayPost().
    void off(const char* why) noexcept;
    /// Checks that the bench may continue. Errors: Stopped; Device after a fault or if the driving sensor failed; Io if
    /// the session cannot be written.
    [[nodiscard]] Result<void> health() const;
    void attend(Seconds within) noexcept {
        if (!config.watched || config.watched()) loop->attend(config.clock->now() + toInstant(within));
    }
    /// If the unit's earlier deliveries are not known, waits until the unit has rested. Errors: as health().
    [[nodiscard]] Result<void> rest();
    /// Leaves Faulted. Each cause is checked again, here or before anything else can be delivered:
    ///   device lost, device fault, status missing   the device must answer and deliver nothing
    ///   stale sensor, a failed sensor               the sensor must answer
    ///   loop silent                                 the loop must step again
    ///   open, short, net charge, limit broken       the check pulse with which arming begins shows it, see
    ///                                               ControlLoop::judgeCheck();
    ///                                               a source that does not read back arms on the operator's word
    ///   internal error                              never goes away: the program must be restarted
    /// Errors: NotArmed while the cause persists.
    [[nodiscard]] Result<void> leaveFault(std::optional<std::uint64_t> known, ResetBy by);
    /// True if a manually driven train was refused after the caller last saw a refusal.
    [[nodiscard]] bool refusedByHand() const noexcept {
        return driving.load(std::memory_order_acquire) == DriveSource::Manual && loop->refusals() != refusalsSeen;
    }
    [[nodiscard]] Result<void> refusal();
    [[nodiscard]] bool isArmed() const noexcept {
        const auto state = interlock.state();
        return state != InterlockState::Disarmed && state != InterlockState::Disconnected;
    }
    /// Gives a board that takes one this bench's profile for this load, and checks what the board has. Errors: NotArmed
    /// while armed, if it has another, and if it does not take it; as ArmingTerms::checkEncoder().
    [[nodiscard]] Result<void> fitBoard(const Load& load);
    /// Checks that a presentation may begin now. Errors: NotArmed; as health().
    [[nodiscard]] Result<void> readyToPresent() const;
    [[nodiscard]] Result<std::unique_ptr<FingerInput>> makeFinger(const Profile& profile);
    [[nodiscard]] std::unique_ptr<TrainPlanner> makePlanner(const Profile& profile);
    /// Returns null if there is no such device or it reports nothing.
    [[nodiscard]] const ReportingDevice* reportingDevice(Role role) const noexcept;

    BenchConfig config;
    const Instant opening{config.clock->now()};
    BenchCalibration calibration{config};
    std::unique_ptr<UnitRecord> record;  // the stimulator's record, if one is kept; outlives the parts that write to it
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
    Result<void> boardFits;          // what fitBoard() found for the load that is armed
    std::uint64_t refusalsSeen = 0;  // refusals already shown to the caller of drive(), wait() and capture()

    BenchTime time{*config.clock, output, order};  // last, so that its threads end first
    BenchLevels levels{config, output, calibration, terms, notes, gate, time, loop};

private:
    /// True if certainly no train came out in the last 8 s.
    [[nodiscard]] bool hasRested() const noexcept;
    [[nodiscard]] Result<void> lookIntoFault();
    [[nodiscard]] Result<void> letReportsBeJudged();
    [[nodiscard]] Result<void> takeUpRecord();
    [[nodiscard]] Result<void> openRecorder(ControlLoop::Parts& parts);
    [[nodiscard]] Result<void> noteBoard();
    void openScope();
    void noteCapture(Capture& capture);
};

}  // namespace tacto
