// PilotParticipant.h - the interface through which a pilot session reaches its two people: either a window with a
// person in front of it, or a virtual participant. The session does not know which.
//
// The session calls show() and ask() from its own thread (a script's). An implementation with a window passes them to
// the window's thread and waits there; a virtual participant answers at once from what was delivered.
//
// Thread-safety: show(), ask(), delivered(), takeEarly() and letGoWasBounce() have one caller, the session's thread;
// cancel(), holding(), hindrance() and hasScreen() may be called from any thread; `stop` is called from any thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/pilot/Prompt.h"

namespace tacto {

/// One presentation as approved and delivered. A virtual participant feels it; a window ignores it. After a resume the
/// session repeats the presentations of earlier parts, so that what was learned is known.
struct FeltPresentation {
    double level = 0;     ///< mA, or a massager's intensity (0 to 1); 0: an empty presentation
    Seconds interval{0};  ///< from onset to onset
    double weaker = 0;    ///< in a comparison, the other of its two levels; else 0
    int inInterval = 0;   ///< interval (1 or 2) of a detection trial's train or of the stronger train; else 0
    std::string named;    ///< familiarisation: the key of the condition named on the screen; else empty
    std::string likely;   ///< what a virtual participant says of it, in the words of its target; empty: not known
    /// How long trains were given in this session before this presentation; adaptation depends on this time.
    Seconds stimulated{0};
    /// The key for drawing the person's answer, such as "seed 1 session 2 test 17". A resume does not change the key.
    std::string drawnFor;
};

/// What a session has on disk. It changes at the same moments of a trial for every condition, level and answer.
struct PilotCounts {
    int answers = 0;  ///< answers to presentations
    int voided = 0;   ///< presentations that were begun and do not count
    int blocks = 0;   ///< of the test
};

/// An obstacle to a presentation that is not a fault.
struct Hindrance {
    bool isBreak = false;  ///< the operator wants a break; if false, see `why`
    std::string why;
};

// Stops without a press of STOP. A stop for a lost screen begins with the text kScreenGone; the others are exactly
// these texts. After kOperatorPauses the session continues once the break is over.
inline constexpr const char* kScreenGone = "the participant's screen";
inline constexpr const char* kOperatorPauses = "operator (break now)";
inline constexpr const char* kOperatorAborts = "operator (abort)";
inline constexpr const char* kParticipantLetGo = "participant let go";

/// How often `waiting` is called while ask() waits for a person.
inline constexpr Seconds kWaitingLook{0.1};

class PilotParticipant {
public:
    virtual ~PilotParticipant() = default;

    /// Changes both screens without waiting for a person. Key presses between this call and the next ask() are early.
    virtual void show(const PilotScreen& screen) = 0;
    /// Shows the targets, not before `prompt.targetsAt`, and waits for the answer.
    /// Errors: Stopped when a person stopped or cancel() was called during the wait; NotFound, naming the prompt, if
    /// there is no one to answer; Device when the screen is gone.
    /// A prompt named "stop-test" (of kind GoOn) is answered by pressing STOP, and so returns Stopped.
    [[nodiscard]] virtual Result<PilotAnswer> ask(const PilotPrompt& prompt) = 0;
    /// Tells the operator how far the session is. Does not wait.
    virtual void counted(const PilotCounts& /*counts*/) {}
    /// Tells the participant what was just presented, before the question about it.
    virtual void delivered(const FeltPresentation& felt) = 0;
    /// Returns and forgets the presses since the last show() that came before the targets.
    [[nodiscard]] virtual std::vector<EarlyPress> takeEarly() = 0;
    /// Ends the session: makes a waiting ask() and every later ask() return Stopped.
    virtual void cancel() noexcept = 0;
    /// The session is over and its bench is destroyed next: after this call, `stop` is never called again.
    virtual void leave() noexcept {}

    /// Whether the participant still holds the key, pedal or target while levels rise. From the answer to a Hold prompt
    /// until the session shows Rest, letting go also calls `stop(kParticipantLetGo)`.
    [[nodiscard]] virtual bool holding() const noexcept = 0;
    /// After a stop by kParticipantLetGo: true if the contact bounced, that is, closed again sooner than a finger can
    /// press. Waits until that is known, 20 ms at most. The output is off either way.
    [[nodiscard]] virtual bool letGoWasBounce() { return false; }
    /// Returns what hinders a presentation now: the operator's break, or a participant's window without the keyboard.
    /// Without a window there is no hindrance.
    [[nodiscard]] virtual std::optional<Hindrance> hindrance() const { return {}; }
    /// Whether the participant can see their screen. `stop` is called with kScreenGone before this becomes false.
    [[nodiscard]] virtual bool hasScreen() const noexcept { return true; }
    /// Whether ask() takes real time. A virtual participant answers at once: the session then lets the answer's `after`
    /// pass on the bench's clock.
    [[nodiscard]] virtual bool answersInRealTime() const noexcept = 0;

    /// Switches the output off at once. `by` is "participant", kParticipantLetGo, "operator", kOperatorAborts,
    /// kOperatorPauses, or kScreenGone if the participant's window was closed or its screen was lost. The session sets
    /// it before the first show(); any thread may call it until the session ends. Does not block.
    std::function<void(const char* by)> stop;
    /// Set by the session; may be null. ask() calls this on the session's thread every kWaitingLook while it waits for
    /// a person.
    std::function<void()> waiting;
};

}  // namespace tacto
