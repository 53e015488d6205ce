// PilotStage.h - the stage of a pilot session: presents, asks and records one thing at a time, and continues after a
// stop or a fault once both people agree. The procedures of a session use it.
//
// A step that has an answer in the record does not happen again. ready() arms the output, which stays armed until
// rest(), a break, a stop or a fault, or until the participant's window has lacked the keyboard for too long.
//
// Errors of all calls: Stopped when the session ended or was interrupted (see ended()); Io when a row cannot be
// written, always before a train; LimitExceeded and Device as the bench.
//
// Thread-safety: one caller, the session's thread; any thread may call the participant's `stop`.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/bench/Bench.h"
#include "core/pilot/PilotOutput.h"
#include "core/pilot/PilotParticipant.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotSettings.h"
#include "core/pilot/VibrationWatch.h"

namespace tacto {

/// One presentation with its question.
struct StageTrial {
    std::string name;                                 ///< the name in the trial's rows, for example "test 17"
    nlohmann::json about = nlohmann::json::object();  ///< members for both rows: number, phase, block, condition
    double level = 0;                                 ///< in the unit of the settings; 0: an empty presentation
    double weaker = 0;                                ///< in a comparison, the weaker of the two levels; else 0
    Presentation presentation;
    PilotPrompt prompt;
    bool asks = true;  ///< false: nothing is asked, and the answer has no response
    /// Shown from before the first train until the targets appear. With ScreenState::Interval the screen marks each of
    /// a trial's two intervals as it passes.
    PilotScreen screen;
    FeltPresentation felt;     ///< the caller sets `named` and `inInterval`; the stage sets the rest
    bool askedAgain = false;   ///< this is the second time: no answer now is final
    bool stopAnswers = false;  ///< a stop by the participant is the answer "stop", recorded once they want to continue
    bool held = false;         ///< levels rise: presented only while the participant holds
    bool counts = true;        ///< the presentation adds to the participant's stimulated time
    std::string drawnAs;       ///< the key for drawing a virtual participant's answer; empty: `name`
};

/// How long a trial stimulates: each train counts until the next train could have come.
[[nodiscard]] inline Seconds lengthOf(const StageTrial& trial) {
    const Seconds trains = static_cast<double>(trial.presentation.onsets.size()) * trial.presentation.interval;
    return trial.level > 0 ? std::min(trains, trial.presentation.duration) : Seconds(0);
}

struct StageAnswer {
    std::string response;  ///< key of the answer; empty without an answer
    double rt_s = 0;       ///< NaN without an answer
    std::size_t attempt = 1;
    bool given = true;
    bool replayed = false;
    std::optional<BurstFigures> vibration;  ///< what the massager did; nothing if it was not measured
};

class PilotStage {
public:
    using Json = nlohmann::json;

    /// All arguments must outlive the stage. The constructor sets the participant's `stop`.
    PilotStage(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings);
    ~PilotStage();
    PilotStage(const PilotStage&) = delete;
    PilotStage& operator=(const PilotStage&) = delete;

    /// Presents, asks and records; if the record has the answer, returns that answer.
    [[nodiscard]] Result<StageAnswer> trial(const StageTrial& trial);
    /// Asks without presenting. The row, of kind `kind`, holds key, keys or value, and `rt_s`.
    [[nodiscard]] Result<Json> ask(const char* kind, const std::string& name, const PilotPrompt& prompt);
    /// Arms the output. If the session was resumed, first reaches the participant's accepted levels again.
    [[nodiscard]] Result<void> ready() { return output_.ready(); }
    /// Arms without presenting, for the test of the STOPs. If the output is real, the operator confirms it by name.
    [[nodiscard]] Result<void> arm() { return output_.arm(); }
    /// Switches the output off and has the participant read how `phase` goes ("ascending"), once in a session.
    [[nodiscard]] Result<void> instruct(const std::string& phase);
    /// Switches the output off until the operator has answered by name for the event `held`. Asks once for each event.
    [[nodiscard]] Result<void> answeredFor(const PilotHold& held);
    /// Asks the participant to hold (letting go stops the output) and waits until they do.
    [[nodiscard]] Result<void> hold(const PilotPrompt& prompt);
    /// Records the impedance as `name`, with nothing armed before or after. NaN if the stimulator reads nothing back.
    [[nodiscard]] Result<double> measureImpedance(const std::string& name) { return output_.measureImpedance(name); }
    /// Sets a function that measures the electrodes, which may have changed. Called before anything is armed after a
    /// fault, a break, a pause or a lost screen, unless they were measured since. Its errors end the trial.
    void onSeatedAgain(std::function<Result<void>()> measure) { output_.measureAnew = std::move(measure); }
    void electrodesTouched() noexcept { output_.electrodesTouched(); }
    /// For electrodes that failed their check: writes a row and has the operator seat them again. The caller allows
    /// this at most kSeatings times in a row.
    [[nodiscard]] Result<void> seatAgain(const std::string& during, const std::string& why) {
        return output_.seatAgain(during, why);
    }
    static constexpr int kSeatings = PilotOutput::kSeatings;
    /// Recovers after an error in `during`. Returns no error if the session continues.
    [[nodiscard]] Result<void> goOnAfter(const std::string& during, const Error& why) {
        return output_.recover(during, why);
    }
    /// In a rehearsal with a person, who feels nothing: sets FeltPresentation::likely. May be empty.
    std::function<std::string(const FeltPresentation&, const PilotPrompt&)> likelyAnswer;
    /// Looks after a participant who was stimulated: called with the output off once a session that presented anything
    /// was stopped for good. Its errors become a note in the record and change nothing else.
    std::function<Result<void>()> afterCare;
    /// Switches the output off. Nothing is presented until ready().
    void rest() noexcept { output_.rest(); }
    /// Lets time pass, also in a break. Errors: Stopped.
    [[nodiscard]] Result<void> pass(Seconds time);
    /// The participant accepted `level`, presented last as `trial`, or called it too strong. The safety gate is told of
    /// a "too strong" in a replayed answer, since it did not see the trial. In a resumed session ready() reaches an
    /// accepted level again.
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed) {
        return output_.ramp().judged(level, tooStrong, trial, replayed);
    }
    /// Switches the output off and asks the participant, once, whether they meant the doubtful "too strong" about
    /// `trial`. False: it was a slip, and the level may come again.
    [[nodiscard]] Result<bool> meantTooStrong(const std::string& trial);
    /// From now on nothing is presented above `level`, the top of a resumed session's ramp.
    void settle(double level) noexcept { output_.ramp().settle(level); }
    /// Levels rise from zero again: a ramp reaches only levels that are accepted from now on.
    void forgetAccepted() noexcept { output_.ramp().forgetAccepted(); }
    /// Writes the end of the session, once. Returns the error that the script throws; no error for Complete.
    [[nodiscard]] Result<void> end(PilotEnd how, const std::string& why);
    [[nodiscard]] PilotEnd ended() const noexcept { return end_; }
    /// A press of STOP that was not handled yet: whether the participant pressed, and how long it took until the output
    /// was off. Only the test of the STOPs uses this; any other stop is handled by the call that it interrupts.
    using PressedStop = PressedStops::Press;
    [[nodiscard]] std::optional<PressedStop> takeStop() noexcept { return output_.takeStop(); }
    [[nodiscard]] bool stopped() const noexcept { return output_.stopped(); }
    [[nodiscard]] bool isArmed() const noexcept { return output_.isArmed(); }
    /// Begins another order in place of the order stopped before `mark`. Errors: Stopped if the run was stopped.
    [[nodiscard]] Result<void> beginAnew(StopMark mark) { return output_.beginAnew(mark); }
    /// Makes the next stop end the run: no test of the STOPs takes it, and nothing continues after it. Any thread may
    /// call this, before that stop.
    void endRun() noexcept { output_.endRun(); }
    /// Makes waiting prompts return, because the script ends. Any thread may call this.
    void cancel() noexcept;

    [[nodiscard]] Bench& bench() noexcept { return bench_; }
    [[nodiscard]] PilotParticipant& participant() noexcept { return participant_; }
    [[nodiscard]] PilotRecord& record() noexcept { return record_; }
    [[nodiscard]] const PilotSettings& settings() const noexcept { return settings_; }
    [[nodiscard]] PilotSettings& settings() noexcept { return settings_; }
    [[nodiscard]] const ParticipantWords& words() const noexcept { return settings_.words; }
    /// One step of the output in mA, or as an intensity.
    [[nodiscard]] double step() const;
    [[nodiscard]] StimulusLevel levelOf(double level) const;
    /// Returns the last measured impedance in ohms; NaN if none is known.
    [[nodiscard]] double impedance() const noexcept { return output_.impedance(); }
    /// How long trains were given in this and earlier parts.
    [[nodiscard]] Seconds stimulated() const noexcept { return stimulated_; }
    /// Starts the pause that must pass before the next first train.
    void noteAnswered() noexcept { lastAnswer_ = bench_.clock().now(); }
    /// How long a bench in person mode may wait for an answer; prompts of trials are shorter.
    static constexpr Seconds kAskingTimeout{60};

private:
    [[nodiscard]] Result<StageAnswer> replay(const StageTrial& trial, const Json& row);
    [[nodiscard]] Json about(const StageTrial& trial, std::size_t attempt) const;
    /// Returns nothing if the attempt is void without a fault; `late` counts attempts that could not begin in time.
    [[nodiscard]] Result<std::optional<StageAnswer>> attempt(const StageTrial& trial, std::size_t number,
                                                             std::size_t& late);
    [[nodiscard]] Result<StageAnswer> stoppedAnswer(const StageTrial& trial);
    [[nodiscard]] Result<Presented> present(const Presentation& presentation, const StageTrial& trial);
    [[nodiscard]] std::function<void(Seconds, Instant)> passing(const StageTrial& trial);
    [[nodiscard]] Result<void> writeEarly(const StageTrial& trial);
    void feel(const StageTrial& trial);
    void tellCounts();
    void given(const StageTrial& trial) noexcept;

    Bench& bench_;
    PilotParticipant& participant_;
    PilotRecord& record_;
    PilotSettings settings_;
    VibrationWatch vibration_;
    PilotEnd end_ = PilotEnd::Unfinished;
    PilotOutput output_;
    Seconds stimulated_{0};
    Instant lastAnswer_{0};
};

}  // namespace tacto
