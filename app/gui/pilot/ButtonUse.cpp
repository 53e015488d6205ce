#include "app/gui/pilot/ButtonUse.h"

#include <algorithm>

#include "app/gui/pilot/AnswerKeys.h"

namespace tacto::gui {

std::vector<ButtonUse> usualUses(std::size_t buttons) {
    using enum ButtonUse::Does;
    constexpr ButtonUse kStop{Stop, 0}, kHold{Hold, 0};
    const auto answer = [](int number) { return ButtonUse{Answer, number}; };
    if (buttons == 1) return {kStop};
    if (buttons == 2) return {kHold, kStop};
    std::vector<ButtonUse> uses;
    if (buttons <= 5) {
        for (int i = 1; i < int(buttons); ++i) uses.push_back(answer(i));
        uses.push_back(kStop);
        return uses;
    }
    uses = {answer(1), answer(2), answer(3), answer(4), kStop, kStop, kHold, kHold, answer(5), answer(6)};
    uses.resize(buttons);
    return uses;
}

ButtonLabels labelsOf(const std::vector<SeatedDevice>& seats) {
    ButtonLabels labels;
    const auto buttonFor = [](const SeatedDevice& seat, const ButtonUse& use) {
        const auto found = std::size_t(std::ranges::find(seat.uses, use) - seat.uses.begin());
        return found < seat.device.buttons.size() ? QString::fromStdString(seat.device.buttons[found]) : QString();
    };
    for (const auto& seat : seats) {
        if (seat.whose != PromptTo::Participant) continue;
        const bool hasStops = !labels.stops.isEmpty();
        if (labels.hold.isEmpty()) labels.hold = buttonFor(seat, {ButtonUse::Does::Hold, 0});
        for (std::size_t i = 0; i < seat.uses.size() && !hasStops; ++i) {
            if (seat.uses[i].does != ButtonUse::Does::Stop) continue;
            labels.stops << (seat.uses.size() > 1 ? QString::fromStdString(seat.device.buttons[i]) : QString());
        }
        if (seat.answers() <= int(labels.answers.size())) continue;
        labels.answers.clear();
        for (int i = 1; i <= seat.answers(); ++i) labels.answers << buttonFor(seat, {ButtonUse::Does::Answer, i});
    }
    return labels;
}

int SeatedDevice::answers() const {
    int reached = 0;
    while (std::ranges::find(uses, ButtonUse{ButtonUse::Does::Answer, reached + 1}) != uses.end()) ++reached;
    return reached;
}

std::optional<int> AnswerButtons::targetOf(int answer, const PilotPrompt& prompt) const {
    if (prompt.kind == PromptKind::Scale || prompt.kind == PromptKind::Several || prompt.kind == PromptKind::Hold)
        return std::nullopt;
    const int count = targetCount(prompt);
    return answer >= 1 && answer <= count && count <= reached ? std::optional(answer - 1) : std::nullopt;
}

QStringList AnswerButtons::textsFor(const PilotPrompt& prompt) const {
    QStringList texts;
    for (int i = 0; i < targetCount(prompt) && targetOf(i + 1, prompt) == i; ++i) texts << labels.answers.value(i);
    return texts;
}

}  // namespace tacto::gui
