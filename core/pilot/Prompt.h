// Prompt.h - what a person in a pilot session is asked, what they answer, and what their screen shows meanwhile.
//
// Units: times are Seconds, moments are Instants of the session's clock, scales are whole numbers. Keys of targets are
// the words that the record keeps (resources/design/pilot.md, sections 4, 6 and 10); texts are what people read.
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

namespace tacto {

/// Which of the two people is asked. Both: each has to answer, and the participant's answer counts.
enum class PromptTo { Participant, Operator, Both };
[[nodiscard]] std::string_view nameOf(PromptTo to) noexcept;  // "participant", "operator", "both"

enum class PromptKind {
    Hold,       ///< hold a key, a pedal or the target until asked to release it; key "held"
    Strength,   ///< "nothing", "weak", "strong", "too-strong"
    Interval,   ///< "first", "second"
    Condition,  ///< the four conditions in a 2 × 2 field (rough, smooth; firm, light), then "none" and "not-sure"
    YesNo,      ///< "yes", "no"
    GoOn,       ///< "go-on": nothing happens until it is pressed
    Choice,     ///< one of `targets`: naturalness, which encoding was easier, a skin score
    Several,    ///< any number of `targets`, or none: qualities
    Scale,      ///< a whole number from `least` to `most`: intensity, pain, severity
    Text,       ///< a line of text: the electrodes' lot, a note. Never a name
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
    std::string name;  ///< the question's name in the record: "identification", "skin", "intensity"
    std::string text;  ///< the question
    /// The targets in the order in which they are shown, always at the same place. Empty for Text, Scale and Hold.
    std::vector<PromptTarget> targets;
    /// Targets appear now or later, never before; the response time starts with them. A press before counts as early.
    Instant targetsAt{0};
    /// The time after which a missing answer counts as empty; nothing: waits.
    std::optional<Seconds> within;
    int least = 0, most = 10;  ///< Scale
    std::string leastText;     ///< Scale: what its ends mean
    std::string mostText;
    std::string noEnds;  ///< YesNo: why a no ends the session, which its row says; empty: it does not
};

struct PilotAnswer {
    std::vector<std::string> keys;  ///< one; any number for Several; the text for Text. Empty for Scale: see `value`
    std::optional<int> value = {};  ///< Scale
    /// The time from the appearance of the targets to the press.
    Seconds after{0};
    /// False: `within` passed without an answer.
    bool given = true;

    /// The only key; empty without one.
    [[nodiscard]] std::string_view key() const noexcept { return keys.empty() ? std::string_view() : keys.front(); }
};

/// A press that came before the targets: recorded, and no answer.
struct EarlyPress {
    std::string key;  ///< the answer that it would have been; empty where the key has no target
    Instant at{0};
};

/// What is going on, for the two screens. Only `operatorText` and `named` may depend on a condition.
enum class ScreenState {
    Rest,      ///< nothing happens
    Dot,       ///< a presentation is about to start
    Feel,      ///< trains may come; the same pixels as Dot for every condition
    Interval,  ///< a detection trial of two intervals; `interval` says which passes
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
    int trial = 0;      ///< the trial within the phase, for the operator; 0: none
    int trials = 0;
    double impedance_ohm = kNaN;   ///< |Z| as measured by itself before the block, not by a train; NaN: not measured
    int interval = 0;              ///< 1 or 2 with Interval; 0: neither, before them or between
    std::string named;             ///< Named: the name of what is or was felt
    std::optional<bool> right;     ///< training: whether the answer was right
    std::optional<Instant> until;  ///< Break: its earliest end
    std::string text;              ///< what the participant reads; the same for every condition
    std::string operatorText;      ///< what the operator reads; hidden while they are blind
    bool operatorMayKnow = false;  ///< `operatorText` has nothing that depends on a condition
};

// Names of questions to the operator: the participant's window is to be shown again; why they aborted.
inline constexpr const char* kScreenPrompt = "screen-gone";
inline constexpr const char* kReasonPrompt = "abort-reason";

/// The four answers in their field of two rows and two columns, in the first of kAnswerWays ways; the places have keys
/// and buttons 1 to 4. The others turn it and swap its rows and columns: answers in one line stay in one line.
inline constexpr std::array<std::string_view, 4> kAnswerPlaces{"smooth-high", "rough-high", "smooth-low", "rough-low"};
inline constexpr std::size_t kAnswerWays = 8;
/// `way` below kAnswerWays.
[[nodiscard]] std::vector<std::string> answersIn(std::size_t way);

// Prompts that are the same wherever they are put. Texts are the ones shown.
[[nodiscard]] PilotPrompt holdPrompt();
[[nodiscard]] PilotPrompt strengthPrompt();
[[nodiscard]] PilotPrompt intervalPrompt();
[[nodiscard]] PilotPrompt comparisonPrompt();
/// `names`: keys of the conditions, each at its place.
[[nodiscard]] PilotPrompt conditionPrompt(const std::vector<std::string>& names);
[[nodiscard]] PilotPrompt yesNoPrompt(std::string name, std::string text, PromptTo to = PromptTo::Participant);
[[nodiscard]] PilotPrompt goOnPrompt(std::string text, PromptTo to = PromptTo::Both);
[[nodiscard]] PilotPrompt scalePrompt(std::string name, std::string text, int least, int most,
                                      PromptTo to = PromptTo::Participant);
[[nodiscard]] PilotPrompt choicePrompt(std::string name, std::string text, std::vector<PromptTarget> targets,
                                       PromptTo to = PromptTo::Participant);

}  // namespace tacto
