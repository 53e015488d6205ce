// PilotParticipant.h - the interface through which a pilot session reaches its two people: a window with a person
// before it, or a virtual participant. The session does not know which.
//
// The session calls show() and ask() from its own thread (a script's). An implementation with a window hands them to
// the window's thread and waits there; a virtual one answers at once from what was delivered.
//
// Thread-safety: show(), ask(), delivered() and takeEarly() have one caller, the session's thread, and so has
// letGoWasBounce(); cancel(), holding(), hindrance() and hasScreen() may be called from any thread; `stop` is called
// from any thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/pilot/Prompt.h"

namespace tacto {

/// One presentation as it was approved and delivered: what a virtual participant feels. A window ignores it. After a
/// resume the session repeats those of earlier parts, so that what was learned is known.
struct FeltPresentation {
    double level = 0;     ///< mA, or a massager's intensity (0 to 1); 0: an empty presentation
    Seconds interval{0};  ///< onset to onset
    double weaker = 0;    ///< in a comparison, the other of its two levels; else 0
    int inInterval = 0;   ///< 1 or 2: where the train of a detection trial, or the stronger of two, came; else 0
    std::string named;    ///< familiarisation: the condition's key, as the screen said; else empty
    /// How long trains were given in this session before this presentation: adaptation follows from it.
    Seconds stimulated{0};
    /// The key for drawing the person's answer: "seed 1 session 2 test 17", the same however often it was resumed.
    std::string drawnFor;
};

/// An obstacle to a presentation that is not a fault.
struct Hindrance {
    bool isBreak = false;  ///< the operator wants one; else what `why` says, half a sentence
    std::string why;
};

// Stops without a press of STOP: the first begins with this, the others are these. After kOperatorPauses the session
// continues once the wanted break is over.
inline constexpr const char* kScreenGone = "the participant's screen";
inline constexpr const char* kOperatorPauses = "operator (break now)";
inline constexpr const char* kOperatorAborts = "operator (abort)";
inline constexpr const char* kParticipantLetGo = "participant let go";

/// How often `waiting` is called while a person is asked.
inline constexpr Seconds kWaitingLook{0.1};

class PilotParticipant {
public:
    virtual ~PilotParticipant() = default;

    /// Changes both screens; does not wait for a person. Keys pressed from here to the next ask() are early.
    virtual void show(const PilotScreen& screen) = 0;
    /// Shows the targets, not before `prompt.targetsAt`, and waits for the answer.
    /// Errors: Stopped when a person stopped or cancel() was called while it waited; NotFound where there is no one to
    /// answer, naming the prompt; Device when the screen is gone.
    /// A prompt named "stop-test" (one of GoOn) is answered by pressing STOP, and so returns Stopped.
    [[nodiscard]] virtual Result<PilotAnswer> ask(const PilotPrompt& prompt) = 0;
    /// Tells what was just presented, before the question about it.
    virtual void delivered(const FeltPresentation& felt) = 0;
    /// Presses since the last show() that came before targets; empties the list.
    [[nodiscard]] virtual std::vector<EarlyPress> takeEarly() = 0;
    /// Makes a waiting ask() return Stopped, and every later one: the session is over.
    virtual void cancel() noexcept = 0;
    /// The session is over and its bench goes next: once this returns, `stop` is not called any more.
    virtual void leave() noexcept {}

    /// Whether the participant still holds the key, pedal or target, while levels rise. From Hold's answer until the
    /// session shows Rest, letting go also calls `stop(kParticipantLetGo)`.
    [[nodiscard]] virtual bool holding() const noexcept = 0;
    /// After a stop by kParticipantLetGo, whether it was the contact and not the participant, since the held thing went
    /// down again sooner than a finger can. Waits until that is known, 20 ms at most. The output is off either way.
    [[nodiscard]] virtual bool letGoWasBounce() { return false; }
    /// Why no presentation may start now: the operator's break, or a participant's window without the keys. Without a
    /// window nothing stands in the way.
    [[nodiscard]] virtual std::optional<Hindrance> hindrance() const { return {}; }
    /// The participant sees what is shown. Before it is false `stop` was called with kScreenGone.
    [[nodiscard]] virtual bool hasScreen() const noexcept { return true; }
    /// Whether ask() takes time by the clock on the wall. A virtual participant takes none: the session lets the
    /// answer's `after` pass on the bench's clock.
    [[nodiscard]] virtual bool answersInRealTime() const noexcept = 0;

    /// Output off at once; by: "participant", kParticipantLetGo, "operator", kOperatorAborts, kOperatorPauses, and
    /// kScreenGone where the participant's window was closed or its screen went. Set by the session before the first
    /// show(); any thread may call it, at any time until the session ends. Does not block.
    std::function<void(const char* by)> stop;
    /// Called by ask(), on the session's thread and every kWaitingLook, while it waits for a person; may be null. Set
    /// by the session.
    std::function<void()> waiting;
};

}  // namespace tacto
