// PilotStage.h - where a pilot session happens: presents, asks and records one thing at a time, and continues after a
// stop or a fault when the people say so. The procedures are written against it.
//
// Nothing that has an answer in the record happens again. ready() arms the output, which stays armed until rest(), a
// break, a stop or a fault, or until the participant's window has been without the keys for long (PilotOutput.h).
//
// Errors of all calls: Stopped when the session ended or was interrupted (end() says which); Io when a row cannot be
// written, which comes before any train; LimitExceeded and Device as the bench's.
//
// Thread-safety: one caller, the session's thread; the participant's `stop` comes from any thread.
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
    std::string name;                                 ///< the name in its rows: "test 17"
    nlohmann::json about = nlohmann::json::object();  ///< into both rows: number, phase, block, condition
    double level = 0;                                 ///< in the settings' unit; 0: empty
    double weaker = 0;                                ///< in a comparison, the other of its two levels; else 0
    Presentation presentation;
    PilotPrompt prompt;
    bool asks = true;  ///< false: nothing is asked, and its answer has no response
    /// Shown from before the first train until the targets appear; with ScreenState::Interval it marks the two
    /// intervals of a trial as they pass.
    PilotScreen screen;
    FeltPresentation felt;     ///< `named` and `inInterval`; the stage fills in the rest
    bool askedAgain = false;   ///< this is the second time: no answer is final
    bool stopAnswers = false;  ///< a participant's stop is the answer to it ("stop"), once they want to continue
    bool held = false;         ///< levels rise: not presented while the participant does not hold
    bool counts = true;        ///< adds to how long the participant was stimulated
    std::string drawnAs;       ///< the key with which the answer is drawn; empty: `name`
};

/// How long it stimulates: each of its trains counts until the next could have come.
[[nodiscard]] inline Seconds lengthOf(const StageTrial& trial) {
    const Seconds trains = static_cast<double>(trial.presentation.onsets.size()) * trial.presentation.interval;
    return trial.level > 0 ? std::min(trains, trial.presentation.duration) : Seconds(0);
}

struct StageAnswer {
    std::string response;  ///< key; empty without an answer
    double rt_s = 0;       ///< NaN without an answer
    std::size_t attempt = 1;
    bool given = true;
    bool replayed = false;
    std::optional<BurstFigures> vibration;  ///< what the massager did; nothing where it was not measured
};

class PilotStage {
public:
    using Json = nlohmann::json;

    /// All arguments outlive the stage. Sets the participant's `stop`.
    PilotStage(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings);
    ~PilotStage();
    PilotStage(const PilotStage&) = delete;
    PilotStage& operator=(const PilotStage&) = delete;

    /// Presents, asks, records; or returns what the record holds.
    [[nodiscard]] Result<StageAnswer> trial(const StageTrial& trial);
    /// Asks without presenting; `kind` of the row. The row holds key, keys or value, and `rt_s`.
    [[nodiscard]] Result<Json> ask(const char* kind, const std::string& name, const PilotPrompt& prompt);
    /// Arms, after the participant's own levels were reached again where the session was resumed.
    [[nodiscard]] Result<void> ready() { return output_.ready(); }
    /// Arms and presents nothing: for the test of the STOPs. Where the output is real, the operator confirms it by
    /// name.
    [[nodiscard]] Result<void> arm() { return output_.arm(); }
    /// Nothing is presented until the operator has answered by name what happened; asked once. Output off.
    [[nodiscard]] Result<void> answeredFor(const PilotHold& held);
    /// The participant holds, and lets go to stop. Waits until they do.
    [[nodiscard]] Result<void> hold();
    /// |Z|, with nothing armed before or after; into the record as `name`. NaN where the stimulator reads nothing back.
    [[nodiscard]] Result<double> measureImpedance(const std::string& name) { return output_.measureImpedance(name); }
    /// Called before anything is armed after a fault, a break, a pause and a lost screen, where the electrodes were not
    /// measured since: they may be others than they were. Its errors end the trial.
    void onSeatedAgain(std::function<Result<void>()> measure) { output_.measureAnew = std::move(measure); }
    void electrodesTouched() noexcept { output_.electrodesTouched(); }
    /// Electrodes did not pass their check: writes a row and has the operator seat them again. At most kSeatings times
    /// in a row, which the caller counts.
    [[nodiscard]] Result<void> seatAgain(const std::string& during, const std::string& why) {
        return output_.seatAgain(during, why);
    }
    static constexpr int kSeatings = PilotOutput::kSeatings;
    /// Continues after an error of the participant's: nothing when the session continues.
    [[nodiscard]] Result<void> goOnAfter(const std::string& during, const Error& why) {
        return output_.recover(during, why);
    }
    /// Called with the output off once a session in which something was presented was stopped for good: who was
    /// stimulated is looked after. Its errors are a note in the record and change nothing else.
    std::function<Result<void>()> afterCare;
    /// Output off. Nothing is presented until ready().
    void rest() noexcept { output_.rest(); }
    /// Lets time pass, in a break too. Errors: Stopped.
    [[nodiscard]] Result<void> pass(Seconds time);
    /// The participant accepted `level`, which was presented last as `trial`, or called it too strong. The gate is told
    /// what it does not know: of a replayed answer that it was too strong. An accepted level is reached again by
    /// ready() where the session was resumed.
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed) {
        return output_.ramp().judged(level, tooStrong, trial, replayed);
    }
    /// Nothing is presented above `level` from now on: the top of a resumed session's ramp.
    void settle(double level) noexcept { output_.ramp().settle(level); }
    /// Writes the row and ends the session, once. The error is what the script is to throw; none for Complete.
    [[nodiscard]] Result<void> end(PilotEnd how, const std::string& why);
    [[nodiscard]] PilotEnd ended() const noexcept { return end_; }
    /// A stop that was pressed since the last one was handled: by the participant or not, and how long it took until
    /// the output was off. For the test of the STOPs; any other stop is handled where it interrupts.
    using PressedStop = PressedStops::Press;
    [[nodiscard]] std::optional<PressedStop> takeStop() noexcept { return output_.takeStop(); }
    [[nodiscard]] bool stopped() const noexcept { return output_.stopped(); }
    [[nodiscard]] bool isArmed() const noexcept { return output_.isArmed(); }
    /// Begins another order in place of the one that was stopped before `mark`. Errors: Stopped, when the run was.
    [[nodiscard]] Result<void> beginAnew(StopMark mark) { return output_.beginAnew(mark); }
    /// From here on a stop stops the run: no test takes it for its own, and nothing continues after it. Any thread,
    /// before that stop.
    void endRun() noexcept { output_.endRun(); }
    /// Wakes the people's prompts: for the end of the script. Any thread.
    void cancel() noexcept;

    [[nodiscard]] Bench& bench() noexcept { return bench_; }
    [[nodiscard]] PilotParticipant& participant() noexcept { return participant_; }
    [[nodiscard]] PilotRecord& record() noexcept { return record_; }
    [[nodiscard]] const PilotSettings& settings() const noexcept { return settings_; }
    [[nodiscard]] PilotSettings& settings() noexcept { return settings_; }
    /// mA, or intensity, of one step of the output.
    [[nodiscard]] double step() const;
    [[nodiscard]] StimulusLevel levelOf(double level) const;
    /// |Z| measured last; NaN where none is known.
    [[nodiscard]] double impedance() const noexcept { return output_.impedance(); }
    /// How long trains were given, in this and earlier parts.
    [[nodiscard]] Seconds stimulated() const noexcept { return stimulated_; }
    /// The next first train comes no sooner than a pause after this moment.
    void noteAnswered() noexcept { lastAnswer_ = bench_.clock().now(); }
    /// How long a bench in person mode may wait for an answer: prompts of trials are shorter.
    static constexpr Seconds kAskingTimeout{60};

private:
    [[nodiscard]] Result<StageAnswer> replay(const StageTrial& trial, const Json& row);
    [[nodiscard]] Json about(const StageTrial& trial, std::size_t attempt) const;
    /// Nothing where it is void and nothing is wrong; `late` counts the attempts that could not begin in time.
    [[nodiscard]] Result<std::optional<StageAnswer>> attempt(const StageTrial& trial, std::size_t number,
                                                             std::size_t& late);
    [[nodiscard]] Result<StageAnswer> stoppedAnswer(const StageTrial& trial);
    [[nodiscard]] Result<Presented> present(const Presentation& presentation, const StageTrial& trial);
    [[nodiscard]] std::function<void(Seconds, Instant)> passing(const StageTrial& trial);
    [[nodiscard]] Result<void> writeEarly(const StageTrial& trial);
    void feel(const StageTrial& trial);
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
