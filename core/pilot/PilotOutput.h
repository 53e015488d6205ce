// PilotOutput.h - the output of a pilot session: armed before a presentation, and switched off after a stop, a fault or
// a pause, or when the participant's screen is gone.
//
// A part of PilotStage. This class also waits for whatever hinders a presentation: during the operator's break and
// while the bench is paused the output is off; if the participant's window loses the keyboard, the output is switched
// off after kFocusTimeout, even while a question waits.
//
// Errors of all calls: as PilotStage.
//
// Thread-safety: one caller, the session's thread; stop() and endRun() from any thread. takeStop() and stopped() wait
// while another thread is still handling a press.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/bench/Bench.h"
#include "core/pilot/PilotParticipant.h"
#include "core/pilot/PressedStops.h"

namespace tacto {

class PilotStage;
struct StageTrial;

/// The levels that a participant accepted, and the ramp that reaches them again, step by step, after electrodes may
/// have been touched.
class LevelRamp {
public:
    /// `stage` must outlive this object. `due`: the levels were accepted in an earlier part.
    LevelRamp(PilotStage& stage, bool due) : stage_(stage), due_(due) {}

    /// Does what PilotStage::judged() does.
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed);
    /// Does what PilotStage::settle() does.
    void settle(double level) noexcept { settled_ = level; }

    /// From now on the levels must be reached again before anything is presented.
    void becomeDue() noexcept { due_ = true; }
    /// Levels accepted so far no longer count: the electrodes are seated anew. What was too strong stays.
    void forgetAccepted() noexcept { accepted_.clear(); }
    /// If the ramp is due, presents each accepted level that was not too strong, from the weakest up, while the
    /// participant holds. A level that is too strong now ends the session.
    [[nodiscard]] Result<void> reach();

private:
    [[nodiscard]] bool isFarBelow(double level) const noexcept;
    [[nodiscard]] Result<void> presentAgain(const std::string& name, double level, const std::string& first);

    PilotStage& stage_;
    bool due_;
    std::map<double, std::string> accepted_;                      // level, and the trial in which it was accepted first
    double tooStrong_ = std::numeric_limits<double>::infinity();  // the lowest level so far that was too strong
    std::optional<double> settled_;
};

class PilotOutput {
public:
    static constexpr int kSeatings = 3;            ///< how often in a row electrodes may fail their check
    static constexpr Seconds kFocusTimeout{10};    ///< stays armed so long without keyboard focus
    static constexpr Seconds kScreenTimeout{600};  ///< how long a participant's screen may be gone

    /// `stage` must outlive this object. `rampDue`: the levels were accepted in an earlier part.
    PilotOutput(PilotStage& stage, bool rampDue) : stage_(stage), ramp_(stage, rampDue) {}
    PilotOutput(const PilotOutput&) = delete;
    PilotOutput& operator=(const PilotOutput&) = delete;

    /// Stops the output for a person, or because the participant's screen is gone. Does not block.
    void stop(const char* by) noexcept;
    /// Does what PilotStage::takeStop() does.
    [[nodiscard]] std::optional<PressedStops::Press> takeStop() noexcept { return stops_.takePress(); }
    /// True if the run was stopped, or a stop has come since the last one was handled.
    [[nodiscard]] bool stopped() const noexcept { return stops_.any() || runEnds_; }

    // Does what PilotStage::endRun() does.
    void endRun() noexcept { runEnds_ = true; }
    [[nodiscard]] Result<void> beginAnew(StopMark mark);
    [[nodiscard]] bool isArmed() const noexcept { return armed_; }
    [[nodiscard]] Result<void> arm();
    [[nodiscard]] Result<void> ready();
    void rest() noexcept;
    [[nodiscard]] Result<double> measureImpedance(const std::string& name);
    [[nodiscard]] LevelRamp& ramp() noexcept { return ramp_; }
    [[nodiscard]] double impedance() const noexcept { return impedance_; }
    void setImpedance(double ohm) noexcept { impedance_ = ohm; }
    /// Returns the last result of measureImpedance(); presentations do not change it.
    [[nodiscard]] double checkedImpedance() const noexcept { return checked_; }

    /// Waits until nothing hinders `trial`; if the operator wants a break, runs the break.
    [[nodiscard]] Result<void> clearTheWay(const StageTrial& trial);
    /// Whether the bench is paused. If so, says that on the screens and waits for kHindrancePoll.
    [[nodiscard]] bool isPaused();
    /// For a bench that paused during `trial`: waits until the pause is over and the participant continues.
    [[nodiscard]] Result<void> afterThePause(const StageTrial& trial);
    /// Called every kWaitingLook while a question waits.
    void whileAsked();
    /// Recovers after a stop, a fault or a lost screen. Returns no error if the session continues.
    [[nodiscard]] Result<void> recover(const std::string& during, const Error& why);
    /// Asks, and asks again after each stop once the participant wants to continue.
    [[nodiscard]] Result<PilotAnswer> insist(const PilotPrompt& prompt);
    /// For electrodes or a massager that fail their check, which is not a fault: writes a row `gate` and has the
    /// operator seat them again. A ramp then reaches the levels again.
    [[nodiscard]] Result<void> seatAgain(const std::string& during, const std::string& why);

    /// Notes that electrodes may have changed: they are measured before anything is armed again.
    void electrodesTouched() noexcept { unmeasured_ = true; }
    /// Measures electrodes that may have changed. Its errors end the trial.
    std::function<Result<void>()> measureAnew;

private:
    /// Asks the operator `question`, which names what would be armed; the request contains their yes.
    [[nodiscard]] Result<ArmRequest> confirmed(const char* question);
    [[nodiscard]] Result<void> afterArmingFailed(const std::string& during, const Error& why, int& seatings);
    [[nodiscard]] Result<void> notOver() const;
    [[nodiscard]] Result<void> takeBreak(const std::string& during, PilotScreen screen);
    /// Shows `screen` while `lasts` returns true, with the output off; handles a stop like a stop in a break.
    [[nodiscard]] Result<void> idleWhile(const std::string& during, const PilotScreen& screen,
                                         const std::function<bool()>& lasts);
    [[nodiscard]] Result<void> afterTheFault(const std::string& during, const Error& why);
    /// Handles a lost screen or a stop until the participant may be asked whether they want to continue.
    [[nodiscard]] Result<void> interrupted(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> seatTheirScreen(const std::string& during);
    /// Records who stopped. Returns no error if the session may continue once the participant wants to.
    [[nodiscard]] Result<void> noteStop(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> noteParticipantStop(const std::string& during, const char* by);
    [[nodiscard]] Result<void> noteAbort(const std::string& during);
    [[nodiscard]] Result<void> askToGoOn(const char* key);
    [[nodiscard]] Result<void> askToSee(const std::string& why);
    [[nodiscard]] Result<void> askAboutTheComputer();
    [[nodiscard]] Result<void> measureTouched();

    PilotStage& stage_;
    LevelRamp ramp_;
    PressedStops stops_;
    std::atomic<bool> runEnds_{false};
    bool armed_ = false;
    bool reasonAsked_ = false;
    bool unmeasured_ = false;  // electrodes may have been touched and were not measured since
    Seconds keysGone_{0};      // time for which another window has had the keyboard while a question waits
    double impedance_ = kNaN;
    double checked_ = kNaN;
};

}  // namespace tacto
