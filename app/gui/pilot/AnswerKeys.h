// AnswerKeys.h - which key answers which target: the figures, or six keys under the left or the right hand that lie as
// the targets do.
//
// A set for one hand is for prompts of at most six targets; longer lists always take the figures. A scale takes the
// figure of its value, and T for ten. No key that stops (Space, Esc, Pause) and none that presses buttons is in a set.
//
// Thread-safety: values.
#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "core/pilot/Prompt.h"

namespace tacto::gui {

enum class KeySet { Figures, LeftHand, RightHand };

class AnswerKeys {
public:
    AnswerKeys() = default;
    AnswerKeys(KeySet set, const PilotPrompt& prompt);
    /// What is written on the target, from 0; empty where it has no key.
    [[nodiscard]] QString text(int target) const;
    /// The target that this Qt::Key answers; nothing for every other key.
    [[nodiscard]] std::optional<int> targetOf(int key) const;

private:
    std::vector<int> keys_;  ///< of each target
};

/// How many targets the prompt shows: its own, or one for each value of a scale, one to hold.
[[nodiscard]] int targetCount(const PilotPrompt& prompt);

}  // namespace tacto::gui
