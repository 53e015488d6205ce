// ButtonUse.h - what a button of a game pad or foot switch does for the person to whom the device is assigned.
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
    int answer = 0;  ///< for Answer: the number of the target on the screen, from 1

    bool operator==(const ButtonUse&) const = default;
};

inline constexpr int kMaxAnswers = 6;  ///< most answers to a question that can be given by buttons

/// Returns the default use of each button, until the operator changes it. One button (a pedal): STOP. Two: the first
/// is held while levels rise. Three to five: the last is STOP. More: the fifth and sixth (the shoulder buttons of a
/// game pad) are STOP, and the next two are held.
[[nodiscard]] std::vector<ButtonUse> usualUses(std::size_t buttons);

/// A device, and the person who uses it, for one session.
struct SeatedDevice {
    ButtonDeviceInfo device;
    PromptTo whose = PromptTo::Participant;  ///< Participant or Operator
    std::vector<ButtonUse> uses;             ///< one use per button
    /// Returns the largest n for which the device has buttons for all answers 1 to n.
    [[nodiscard]] int answers() const;
};

/// The button numbers written on the targets that the participant's device can answer.
struct ButtonLabels {
    QStringList answers;  ///< the buttons for answers 1 to n
    QString hold;         ///< empty if no button holds
    QStringList stops;    ///< the STOP buttons of the first device with a STOP; a pedal (one button) has no number
};
/// Returns the labels for the participant's device with the most answers; the hold button may be on another device.
[[nodiscard]] ButtonLabels labelsOf(const std::vector<SeatedDevice>& seats);

/// The target that each of the participant's buttons answers, and the label on that target. Buttons answer a question
/// only if they reach all its targets: targets without a button would be chosen less often. Buttons answer no scale and
/// no question with several answers.
struct AnswerButtons {
    int reached = 0;  ///< answers 1 to `reached` have a button
    ButtonLabels labels;

    /// Returns the target, counted from 0, for an answer counted from 1.
    [[nodiscard]] std::optional<int> targetOf(int answer, const PilotPrompt& prompt) const;
    /// Returns the label of each target; empty if buttons cannot answer the prompt.
    [[nodiscard]] QStringList textsFor(const PilotPrompt& prompt) const;
};

}  // namespace tacto::gui
