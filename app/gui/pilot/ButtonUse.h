// ButtonUse.h - what a button of a game pad or a foot switch does for the person whom the device is assigned to.
//
// Thread-safety: values and pure functions.
#pragma once

#include <QStringList>
#include <optional>
#include <vector>

#include "core/devices/ButtonDevice.h"
#include "core/pilot/Prompt.h"

namespace tacto::gui {

struct ButtonUse {
    enum class Does { Nothing, Stop, Hold, Answer };
    Does does = Does::Nothing;
    int answer = 0;  ///< of Answer: the target's number on the screen, from 1

    bool operator==(const ButtonUse&) const = default;
};

inline constexpr int kMaxAnswers = 6;  ///< of a question that buttons answer

/// What the buttons of a device do, by their number, until the operator says otherwise: one pedal is STOP, of two the
/// first holds, of up to five the last is STOP, and of more the fifth and the sixth are, the shoulder buttons of a game
/// pad; the two after them hold.
[[nodiscard]] std::vector<ButtonUse> usualUses(std::size_t buttons);

/// A device and its person for one session.
struct SeatedDevice {
    ButtonDeviceInfo device;
    PromptTo whose = PromptTo::Participant;  ///< Participant or Operator
    std::vector<ButtonUse> uses;             ///< of each button
    /// Answers 1 to n are all on the device.
    [[nodiscard]] int answers() const;
};

/// What is written on the targets that a device of the participant's reaches: the numbers of its buttons.
struct ButtonLabels {
    QStringList answers;  ///< of answer 1 to n, all of which it reaches
    QString hold;         ///< empty where none holds
    QStringList stops;    ///< of the first device with one; a device of one button is a pedal, and has no number
};
/// The labels are those of the participant's device that reaches the most answers; what holds may be on another.
[[nodiscard]] ButtonLabels labelsOf(const std::vector<SeatedDevice>& seats);

/// Which target of a question the participant's buttons answer, and what is written on it.
/// Buttons answer a question only where they reach all its targets: those that they do not reach would be chosen less.
/// They answer no scale and no question with several answers.
struct AnswerButtons {
    int reached = 0;  ///< answers 1 to this have a button
    ButtonLabels labels;

    /// The target, from 0, of answer 1 to n.
    [[nodiscard]] std::optional<int> targetOf(int answer, const PilotPrompt& prompt) const;
    /// The label of each target; empty where buttons do not answer.
    [[nodiscard]] QStringList textsFor(const PilotPrompt& prompt) const;
};

}  // namespace tacto::gui
