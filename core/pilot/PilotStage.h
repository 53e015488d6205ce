// PilotStage.h - where a pilot session happens: presents, asks and records one thing at a time, and goes on after a
// stop or a fault when the people say so. The procedures are written against it.
//
// Nothing that has an answer in the record happens again. Output is armed by ready() and stays so until rest().
//
// Errors of all calls: Stopped when the session ended or was broken off (end() says which); Io when a row cannot be
// written, which comes before any train; LimitExceeded and Device as the bench's.
//
// Thread-safety: one caller, the session's thread; the participant's `stop` comes from any thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/NaN.h"
#include "core/bench/Bench.h"
#include "core/pilot/Participant.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/PilotSettings.h"
#include "core/pilot/VibrationWatch.h"

namespace tacto {

/// How a session stands when its script has ended.
enum class PilotEnd {
    Unfinished,  ///< broken off; may be resumed
    Complete,
    Stopped,  ///< ended before its end, for good
};
[[nodiscard]] std::string_view nameOf(PilotEnd end) noexcept;  // "unfinished", "complete", "stopped"

/// One presentation with its question.
struct StageTrial {
    std::string name;                                 ///< of its rows: "test 17"
    nlohmann::json about = nlohmann::json::object();  ///< into both rows: number, phase, block, condition
    double level = 0;                                 ///< in the settings' unit; 0: empty
    Presentation presentation;
    PilotPrompt prompt;
    bool asks = true;  ///< false: nothing is asked, and its answer has no response
    /// From before the first train until the targets appear; with ScreenState::Interval it marks the two intervals of
    /// a detection trial as they pass.
    PilotScreen screen;
    FeltPresentation felt;     ///< `named` and `inInterval`; the stage fills in the rest
    bool askedAgain = false;   ///< this is the second time: no answer is final
    bool stopAnswers = false;  ///< a participant's stop is its answer ("stop"), once they want to go on
    bool held = false;         ///< levels rise: not presented while the participant does not hold
    std::string drawnAs;       ///< what the answer is drawn for; empty: `name`
};

/// For how long it stimulates: each of its trains until the next could have come.
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
    std::optional<BurstFigures> vibration;  ///< of a massager; nothing where it was not measured
};

class PilotStage {
public:
    using Json = nlohmann::json;

    /// All outlive the stage. Sets the participant's `stop`.
    PilotStage(Bench& bench, PilotParticipant& participant, PilotRecord& record, PilotSettings settings);
    ~PilotStage();
    PilotStage(const PilotStage&) = delete;
    PilotStage& operator=(const PilotStage&) = delete;

    /// Presents, asks, records; or returns what the record holds.
    [[nodiscard]] Result<StageAnswer> trial(const StageTrial& trial);
    /// Asks without presenting; `kind` of the row. The row holds key, keys or value, and `rt_s`.
    [[nodiscard]] Result<Json> ask(const char* kind, const std::string& name, const PilotPrompt& prompt);
    /// Arms, after the participant's own levels were reached again where the session was resumed.
    [[nodiscard]] Result<void> ready();
    /// Arms and presents nothing: for the test of the STOPs. Where the output is real, the operator confirms it by
    /// name.
    [[nodiscard]] Result<void> arm();
    /// The participant holds, and lets go to stop. Waits until they do.
    [[nodiscard]] Result<void> hold();
    /// |Z|, with nothing armed before or after; into the record as `name`. NaN where the stimulator reads nothing back.
    [[nodiscard]] Result<double> measureImpedance(const std::string& name);
    /// Called once the participant wants to go on after a fault, before anything is presented: what was seated again is
    /// measured anew. Its errors end the trial.
    std::function<Result<void>()> afterFault;
    /// Called with the output off once a session in which something was presented was stopped for good: who was
    /// stimulated is looked after. Its errors change nothing.
    std::function<Result<void>()> afterCare;
    /// Output off. Nothing is presented until ready().
    void rest() noexcept;
    /// Lets time pass, in a break too. Errors: Stopped.
    [[nodiscard]] Result<void> pass(Seconds time);
    /// The participant accepted `level`, which was presented last as `trial`, or called it too strong. The gate is told
    /// what it does not know: of a replayed answer that it was too strong. An accepted level is reached again by
    /// ready() where the session was resumed.
    [[nodiscard]] Result<void> judged(double level, bool tooStrong, const std::string& trial, bool replayed);
    /// Nothing is presented above `level` from now on: the top of a resumed session's ramp.
    void settle(double level) noexcept { settled_ = level; }
    /// Writes the row and ends the session, once. The error is what the script is to throw; none for Complete.
    [[nodiscard]] Result<void> end(PilotEnd how, const std::string& why);
    [[nodiscard]] PilotEnd ended() const noexcept { return end_; }
    /// A stop that was pressed since the last one was handled: by the participant or not, and how long it took until
    /// the output was told. For the test of the STOPs; any other stop is handled where it interrupts.
    struct PressedStop {
        bool participants = false;
        std::chrono::nanoseconds took{0};
    };
    [[nodiscard]] std::optional<PressedStop> takeStop() noexcept;
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
    [[nodiscard]] double impedance() const noexcept { return impedance_; }
    /// For how long trains were given, in this and earlier parts.
    [[nodiscard]] Seconds stimulated() const noexcept { return stimulated_; }

private:
    [[nodiscard]] Result<StageAnswer> replay(const StageTrial& trial, const Json& row);
    [[nodiscard]] Json about(const StageTrial& trial, std::size_t attempt) const;
    [[nodiscard]] Result<std::optional<StageAnswer>> attempt(const StageTrial& trial, std::size_t number);
    [[nodiscard]] Result<Presented> present(const Presentation& presentation, const PilotScreen& screen);
    [[nodiscard]] std::function<void(Seconds)> passing(const PilotScreen& screen);
    [[nodiscard]] Result<void> writeEarly(const StageTrial& trial);
    void feel(const StageTrial& trial);
    void given(const StageTrial& trial) noexcept;
    /// After a stop, a fault or a pause: nothing when the session goes on.
    [[nodiscard]] Result<void> recover(const std::string& during, const Error& why);
    /// Writes who stopped; nothing when it may go on once the participant wants to.
    [[nodiscard]] Result<void> noteStop(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> afterTheFault(const std::string& during, const Error& why);
    [[nodiscard]] Result<void> askToGoOn(const std::string& text);
    /// Of what keeps it from being armed, which is no fault yet: nothing when it is to be tried again.
    [[nodiscard]] Result<void> seatAgain(const std::string& during, const Error& why, int tries);
    [[nodiscard]] Result<void> askToSee(const std::string& why);
    /// Asks again after each stop, once the participant wants to go on.
    [[nodiscard]] Result<PilotAnswer> insist(const PilotPrompt& prompt);
    /// `question` names what would be armed; the operator's yes to it is part of the request.
    [[nodiscard]] Result<ArmRequest> confirmed(const char* question);
    [[nodiscard]] Result<void> ramp();

    Bench& bench_;
    PilotParticipant& participant_;
    PilotRecord& record_;
    PilotSettings settings_;
    VibrationWatch vibration_;
    PilotEnd end_ = PilotEnd::Unfinished;
    std::atomic<const char*> stoppedBy_{nullptr};
    std::atomic<std::chrono::nanoseconds::rep> stopTook_{0};
    bool armed_ = false;
    bool rampDue_ = false;
    std::map<double, std::string> accepted_;                      // Level and the trial in which it was accepted first
    double tooStrong_ = std::numeric_limits<double>::infinity();  // Lowest so far
    std::optional<double> settled_;
    double impedance_ = kNaN;
    Seconds stimulated_{0};
    Instant lastAnswer_{0};
};

}  // namespace tacto
