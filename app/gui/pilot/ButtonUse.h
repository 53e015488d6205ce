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
    int answer = 0;  ///< for Answer: the target's number on the screen, from 1

    bool operator==(const ButtonUse&) const = default;
};

inline constexpr int kMaxAnswers = 6;  ///< answers to a question that buttons can give

/// The usual use of a device's buttons, by their number, until the operator says otherwise: one pedal is STOP; of two
/// the first holds; of up to five the last is STOP; of more the fifth and sixth are STOP, the shoulder buttons of a
/// game pad, and the two after them hold.
[[nodiscard]] std::vector<ButtonUse> usualUses(std::size_t buttons);

/// A device and its person for one session.
struct SeatedDevice {
    ButtonDeviceInfo device;
    PromptTo whose = PromptTo::Participant;  ///< Participant or Operator
    std::vector<ButtonUse> uses;             ///< one for each button
    /// Answers 1 to n are all on the device.
    [[nodiscard]] int answers() const;
};

/// The text on the targets that the participant's device reaches: the numbers of its buttons.
struct ButtonLabels {
    QStringList answers;  ///< the buttons for answer 1 to n; together they reach every answer
    QString hold;         ///< empty where none holds
    QStringList stops;    ///< on the first device with a STOP; a device with one button is a pedal, and has no number
};
/// The labels belong to the participant's device with the most answers; the button that holds may be on another.
[[nodiscard]] ButtonLabels labelsOf(const std::vector<SeatedDevice>& seats);

/// The target that each of the participant's buttons answers, and what is written on it. Buttons answer a question only
/// where they reach all its targets: targets that they do not reach would be chosen less. They answer no scale and no
/// question with several answers.
struct AnswerButtons {
    int reached = 0;  ///< answers 1 to this have a button
    ButtonLabels labels;

    /// The target, from 0, of answer 1 to n.
    [[nodiscard]] std::optional<int> targetOf(int answer, const PilotPrompt& prompt) const;
    /// The label of each target; empty where buttons do not answer.
    [[nodiscard]] QStringList textsFor(const PilotPrompt& prompt) const;
};

}  // namespace tacto::gui
