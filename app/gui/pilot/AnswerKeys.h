// AnswerKeys.h - which key answers which target: the figures, or six keys under the left or the right hand that lie as
// the targets do.
//
// A set for one hand is for prompts of at most six targets; longer lists always take the figures. A scale takes the
// figure of its value, and T for ten. No key that stops (Space, Esc, Pause) and none that presses buttons is in a set.
//
// Thread-safety: values.
#pragma once

#include <QString>
#include <chrono>
#include <map>
#include <optional>
#include <vector>

#include "app/gui/theme/ConfirmButton.h"
#include "core/pilot/Prompt.h"

namespace tacto::gui {

enum class KeySet { Figures, LeftHand, RightHand };

class AnswerKeys {
public:
    AnswerKeys() = default;
    AnswerKeys(KeySet set, const PilotPrompt& prompt);
    /// The text on the target, counted from 0; empty where it has no key.
    [[nodiscard]] QString text(int target) const;
    /// The target that this Qt::Key answers; nothing for every other key.
    [[nodiscard]] std::optional<int> targetOf(int key) const;

private:
    std::vector<int> keys_;  ///< the key of each target
};

/// How many targets the prompt shows: its own, or one for each value of a scale, or one to hold.
[[nodiscard]] int targetCount(const PilotPrompt& prompt);

/// Keys and buttons that went down while no target was there: while still held they do not answer.
class EarlierPresses {
public:
    /// Whether a press is one that went down before: marked as `repeated`, or too soon after the last for another.
    [[nodiscard]] bool isHeld(int code, SteadyTime at, bool repeated) {
        const auto before = last_.find(code);
        const bool held = repeated || (before != last_.end() && at - before->second < kRepeats);
        if (before != last_.end() && held) before->second = at;
        return held;
    }
    void note(int code, SteadyTime at) { last_[code] = at; }
    void forget(int code) { last_.erase(code); }
    void clear() { last_.clear(); }

private:
    static constexpr std::chrono::milliseconds kRepeats{150};  // X does not mark every press of a held key as repeated
    std::map<int, SteadyTime> last_;
};

}  // namespace tacto::gui
