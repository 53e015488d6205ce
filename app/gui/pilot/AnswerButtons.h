// AnswerButtons.h - which target of a question the participant's buttons answer, and what is written on it.
//
// Buttons answer a question only where they reach all its targets: those that they do not reach would be chosen less.
// They answer no scale and no question with several answers.
//
// Thread-safety: values.
#pragma once

#include <QStringList>
#include <optional>

#include "app/gui/pilot/ButtonUse.h"

namespace tacto::gui {

struct AnswerButtons {
    int reached = 0;  ///< answers 1 to this have a button
    ButtonLabels labels;

    /// The target, from 0, of answer 1 to n.
    [[nodiscard]] std::optional<int> targetOf(int answer, const PilotPrompt& prompt) const;
    /// The label of each target; empty where buttons do not answer.
    [[nodiscard]] QStringList textsFor(const PilotPrompt& prompt) const;
};

}  // namespace tacto::gui
