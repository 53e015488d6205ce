#include "app/gui/pilot/AnswerButtons.h"

#include "app/gui/pilot/AnswerKeys.h"

namespace tacto::gui {

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
