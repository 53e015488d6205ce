// PilotOutput.h - the output of a pilot session: armed before something is presented, off again after a stop, a fault
// or a pause, and when the participant's screen has gone.
//
// What PilotStage is made of. What is in the way of a presentation is waited for here: in the operator's break and
// while the bench is paused the output is off; without the keys it is off after kFocusTimeout, also while a question
// waits.
//
// Errors of all calls: as PilotStage.
//
// Thread-safety: one caller, the session's thread; stop() and endRun() from any thread. takeStop() and stopped() wait
// for a press that is under way.
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

/// The levels that a participant accepted, and the ramp over which they are reached again, step by step, after
/// electrodes may have been touched.
class LevelRamp {
public:
    /// `stage` outlives it. `due`: the levels were accepted in an earlier part.
    LevelRamp(PilotStage& stage, bool due) : stage_(stage), due_(due) {}

    /// As PilotStage::judged().
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed);
    /// As PilotStage::settle().
    void settle(double level) noexcept { settled_ = level; }

    /// Levels are reached again before anything is presented.
    void becomeDue() noexcept { due_ = true; }
    /// Presents each accepted level that was not too strong, from the weakest up, while the participant holds; where
    /// that is not due, does nothing. One that is too strong now ends the session.
    [[nodiscard]] Result<void> reach();

private:
    [[nodiscard]] Result<void> presentAgain(const std::string& name, double level, const std::string& first);

    PilotStage& stage_;
    bool due_;
    std::map<double, std::string> accepted_;                      // Level and the trial in which it was accepted first
    double tooStrong_ = std::numeric_limits<double>::infinity();  // Lowest so far
    std::optional<double> settled_;
};

class PilotOutput {
public:
    static constexpr int kSeatings = 3;            ///< in a row, of electrodes that do not pass their check
    static constexpr Seconds kFocusTimeout{10};    ///< it stays armed for so long while another window has the keys
    static constexpr Seconds kScreenTimeout{600};  ///< a participant's screen may be gone so long

    /// `stage` outlives it. `rampDue`: the levels were accepted in an earlier part.
    PilotOutput(PilotStage& stage, bool rampDue) : stage_(stage), ramp_(stage, rampDue) {}
    PilotOutput(const PilotOutput&) = delete;
    PilotOutput& operator=(const PilotOutput&) = delete;

    /// A stop of the output by one of the people, or because the participant's screen is gone. Does not block.
    void stop(const char* by) noexcept;
    /// See PilotStage.
    [[nodiscard]] std::optional<PressedStops::Press> takeStop() noexcept { return stops_.takePress(); }
    /// Whether a stop has come since the last one was handled, or the run's stop.
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
    /// The last result of measureImpedance(): the same whatever is presented.
    [[nodiscard]] double checkedImpedance() const noexcept { return checked_; }

    /// Waits until nothing is in the way of `trial`; a break of the operator's is taken meanwhile.
    [[nodiscard]] Result<void> clearTheWay(const StageTrial& trial);
    /// The bench is paused: looks for kHindrancePoll, in which it says so.
    [[nodiscard]] bool isPaused();
    /// The bench was paused while `trial` was presented: waits until the pause is over and the participant continues.
    [[nodiscard]] Result<void> afterThePause(const StageTrial& trial);
    /// A question waits, and kWaitingLook has passed.
    void whileAsked();
    /// Recovers after a stop, a fault or a lost screen: nothing when the session continues.
    [[nodiscard]] Result<void> recover(const std::string& during, const Error& why);
    /// Asks again after each stop, once the participant wants to continue.
    [[nodiscard]] Result<PilotAnswer> insist(const PilotPrompt& prompt);
    /// Electrodes, or a massager, do not pass their check, which is not a fault: writes a row `gate` and has the
    /// operator seat them again. Levels are then reached again by a ramp.
    [[nodiscard]] Result<void> seatAgain(const std::string& during, const std::string& why);

    /// Electrodes may be others than they were: measured before anything is armed again.
    void electrodesTouched() noexcept { unmeasured_ = true; }
    /// Measures electrodes that may be others than they were. Its errors end the trial.
    std::function<Result<void>()> measureAnew;

private:
    /// `question` names what would be armed; the operator's yes to it is part of the request.
    [[nodiscard]] Result<ArmRequest> confirmed(const char* question);
    [[nodiscard]] Result<void> afterArmingFailed(const std::string& during, const Error& why, int& seatings);
    [[nodiscard]] Result<void> notOver() const;
    [[nodiscard]] Result<void> takeBreak(const std::string& during, PilotScreen screen);
    /// Shows `screen` while `lasts`, with the output off; a stop meanwhile is handled as one in a break.
    [[nodiscard]] Result<void> idleWhile(const std::string& during, const PilotScreen& screen,
                                         const std::function<bool()>& lasts);
    [[nodiscard]] Result<void> afterTheFault(const std::string& during, const Error& why);
    /// A lost screen or a stop, until the participant may be asked whether they want to continue.
    [[nodiscard]] Result<void> interrupted(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> seatTheirScreen(const std::string& during);
    /// Writes who stopped; nothing when it may continue once the participant wants to.
    [[nodiscard]] Result<void> noteStop(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> noteParticipantStop(const std::string& during, const char* by);
    [[nodiscard]] Result<void> noteAbort(const std::string& during);
    [[nodiscard]] Result<void> askToGoOn(const std::string& text);
    [[nodiscard]] Result<void> askToSee(const std::string& why);
    [[nodiscard]] Result<void> measureTouched();

    PilotStage& stage_;
    LevelRamp ramp_;
    PressedStops stops_;
    std::atomic<bool> runEnds_{false};
    bool armed_ = false;
    bool reasonAsked_ = false;
    bool unmeasured_ = false;  // electrodes may have been touched, and not been measured since
    Seconds keysGone_{0};      // how long the keys have been elsewhere while a question waits
    double impedance_ = kNaN;
    double checked_ = kNaN;
};

}  // namespace tacto
