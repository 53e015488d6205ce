// Prompt.h - the questions to a person in a pilot session, their answers, and what their screen shows meanwhile.
//
// Units: times are Seconds, moments are Instants of the session's clock, scales are whole numbers. The keys of targets
// are the words in the record (resources/design/pilot.md, sections 4, 6 and 10); the texts are shown to people.
//
// Thread-safety: values and pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Statistics.h"
#include "core/base/Units.h"
#include "core/pilot/ParticipantWords.h"

namespace tacto {

/// Which of the two people is asked. With Both, each must answer, and the participant's answer is taken.
enum class PromptTo { Participant, Operator, Both };
[[nodiscard]] std::string_view nameOf(PromptTo to) noexcept;  // "participant", "operator", "both"

enum class PromptKind {
    Hold,       ///< hold a key, a pedal or the target until asked to release it; key "held"
    Strength,   ///< "nothing", "weak", "strong", "too-strong"
    Interval,   ///< "first", "second"
    Condition,  ///< the four conditions in a 2 × 2 field (rough, smooth; firm, light), then "none" and "not-sure"
    YesNo,      ///< "yes", "no"
    GoOn,       ///< "go-on": waits until a person presses
    Choice,     ///< one of `targets`: naturalness, which encoding was easier, a skin score
    Several,    ///< any number of `targets`, or none: qualities
    Scale,      ///< a whole number from `least` to `most`: intensity, pain, severity
    Text,       ///< a line of text, such as the electrodes' lot or a note; never a name
};
[[nodiscard]] std::string_view nameOf(PromptKind kind) noexcept;  // "hold", "strength", "interval", ...

struct PromptTarget {
    std::string key;   ///< the key in the record
    std::string text;  ///< the words that the person reads
    bool operator==(const PromptTarget&) const = default;
};

struct PilotPrompt {
    PromptTo to = PromptTo::Participant;
    PromptKind kind = PromptKind::GoOn;
    std::string name;  ///< the question's name in the record, for example "identification", "skin", "intensity"
    std::string text;  ///< the question
    /// The targets in the order in which they are shown; places never change. Empty for Text, Scale and Hold.
    std::vector<PromptTarget> targets;
    /// The earliest time at which targets appear; response times start when they do. An earlier press is an EarlyPress.
    Instant targetsAt{0};
    /// After this time a missing answer is recorded as empty; if not set, the prompt waits.
    std::optional<Seconds> within;
    int least = 0, most = 10;  ///< Scale
    std::string leastText;     ///< Scale: the meaning of its lower end
    std::string mostText;
    std::string noEnds;  ///< YesNo: the reason in the row if a "no" ends the session; empty: a "no" does not end it
};

struct PilotAnswer {
    std::vector<std::string> keys;  ///< one key; several or none for Several; the text for Text; none for Scale
    std::optional<int> value = {};  ///< Scale
    /// Time from the appearance of the targets to the press.
    Seconds after{0};
    /// False if `within` passed without an answer.
    bool given = true;

    /// Returns the first key; an empty text without a key.
    [[nodiscard]] std::string_view key() const noexcept { return keys.empty() ? std::string_view() : keys.front(); }
};

/// A press before the targets appeared: it is recorded, but is not an answer.
struct EarlyPress {
    std::string key;  ///< the answer that the press would have been; empty if the pressed key has no target
    Instant at{0};
};

/// The name of a condition or of another answer to "what did you feel?".
[[nodiscard]] std::string conditionWords(std::string_view key, const ParticipantWords& words);

/// What the two screens show. Only `operatorText` and `named` may depend on a condition.
enum class ScreenState {
    Rest,      ///< nothing happens
    Dot,       ///< a presentation is about to start
    Feel,      ///< trains may come; shows the same pixels as Dot for every condition
    Interval,  ///< a detection trial of two intervals; `interval` says which of them passes
    Named,     ///< familiarisation and feedback: the name in `named` is shown
    Break,     ///< rest between blocks until `until`
    Ended,
};
struct PilotScreen {
    ScreenState state = ScreenState::Rest;
    std::string phase;  ///< "checklist", "ascending", "detection", "range", "familiarisation", "training", "test",
                        ///< "drift", "break", "ratings", "ended"
    int block = 0;      ///< from 1; 0: none
    int blocks = 0;     ///< blocks in the test
    int trial = 0;      ///< number of the trial within the phase, for the operator; 0: none
    int trials = 0;
    double impedance_ohm = kNaN;   ///< impedance measured before the block, not by a train; NaN: not measured
    int interval = 0;              ///< state Interval: 1 or 2; 0: before, between or after the two intervals
    std::string named;             ///< state Named: the name of what is or was felt
    std::optional<bool> right;     ///< training: true if the answer was right
    std::optional<Instant> until;  ///< the earliest end of a break, or of what `operatorText` waits for
    std::string text;              ///< what the participant reads; the same for every condition
    std::string operatorText;      ///< what the operator reads; hidden while the operator is blind
    bool operatorMayKnow = false;  ///< `operatorText` contains nothing that depends on a condition
};

// Names of two questions to the operator: show the participant's window again; why did you abort?
inline constexpr const char* kScreenPrompt = "screen-gone";
inline constexpr const char* kReasonPrompt = "abort-reason";

/// The four answers in a field of two rows and two columns, in the first of kAnswerWays arrangements; the places have
/// keys and buttons 1 to 4. The other arrangements turn or mirror the field: answers in one line stay in one line.
inline constexpr std::array<std::string_view, 4> kAnswerPlaces{"smooth-high", "rough-high", "smooth-low", "rough-low"};
inline constexpr std::size_t kAnswerWays = 8;
/// `way` must be below kAnswerWays.
[[nodiscard]] std::vector<std::string> answersIn(std::size_t way);

// Prompts in the words of the participant.
[[nodiscard]] PilotPrompt holdPrompt(const ParticipantWords& words = ParticipantWords::english());
/// Before a series of rising levels, which begins at zero.
[[nodiscard]] PilotPrompt seriesPrompt(std::size_t series, std::size_t of,
                                       const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt strengthPrompt(const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt meantPrompt(const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt intervalPrompt(const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt comparisonPrompt(const ParticipantWords& words = ParticipantWords::english());
/// `names`: keys of the conditions, in the order of the places.
[[nodiscard]] PilotPrompt conditionPrompt(const std::vector<std::string>& names,
                                          const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt yesNoPrompt(std::string name, std::string text, PromptTo to = PromptTo::Participant,
                                      const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt goOnPrompt(std::string text, PromptTo to = PromptTo::Both,
                                     const ParticipantWords& words = ParticipantWords::english());
[[nodiscard]] PilotPrompt scalePrompt(std::string name, std::string text, int least, int most,
                                      PromptTo to = PromptTo::Participant);
[[nodiscard]] PilotPrompt choicePrompt(std::string name, std::string text, std::vector<PromptTarget> targets,
                                       PromptTo to = PromptTo::Participant);

}  // namespace tacto
