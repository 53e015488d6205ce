// AnswerKeys.h - which key answers which target: the digit keys, or six keys under the left or right hand, laid out
// like the targets.
//
// The six keys of a hand serve prompts of at most six targets; longer lists always use the digits. A scale uses the
// digit of the value, and T for ten. No set contains a key that stops (Space, Esc, Pause) or presses buttons.
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
    /// Returns the key's label for the target, counted from 0; empty if the target has no key.
    [[nodiscard]] QString text(int target) const;
    /// The target that this Qt::Key answers; nothing for every other key.
    [[nodiscard]] std::optional<int> targetOf(int key) const;

private:
    std::vector<int> keys_;  ///< the key of each target
};

/// Returns the number of targets shown: the prompt's own, one for each value of a scale, or one to hold.
[[nodiscard]] int targetCount(const PilotPrompt& prompt);

/// Remembers keys and buttons that went down before any target was shown; while still held they do not answer.
class EarlierPresses {
public:
    /// True if the key was already down: the press is marked as `repeated`, or follows the last press too soon.
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
    static constexpr std::chrono::milliseconds kRepeats{150};  // X does not mark every repeat of a held key as repeated
    std::map<int, SteadyTime> last_;
};

}  // namespace tacto::gui
