#include "app/gui/pilot/AnswerKeys.h"

#include <QKeySequence>
#include <algorithm>
#include <array>

namespace tacto::gui {

namespace {

constexpr std::array kFigures{int(Qt::Key_1), int(Qt::Key_2), int(Qt::Key_3), int(Qt::Key_4), int(Qt::Key_5),
                              int(Qt::Key_6), int(Qt::Key_7), int(Qt::Key_8), int(Qt::Key_9), int(Qt::Key_0),
                              int(Qt::Key_Q), int(Qt::Key_W), int(Qt::Key_E), int(Qt::Key_R), int(Qt::Key_T)};
// Two columns of three keys, laid out like the targets of a trial; the same places on QWERTY and QWERTZ keyboards.
constexpr std::array kLeftHand{int(Qt::Key_W), int(Qt::Key_E), int(Qt::Key_S),
                               int(Qt::Key_D), int(Qt::Key_X), int(Qt::Key_C)};
constexpr std::array kRightHand{int(Qt::Key_U), int(Qt::Key_I), int(Qt::Key_J),
                                int(Qt::Key_K), int(Qt::Key_M), int(Qt::Key_Comma)};

}  // namespace

int targetCount(const PilotPrompt& prompt) {
    if (prompt.kind == PromptKind::Scale) return std::max(0, prompt.most - prompt.least + 1);
    if (prompt.kind == PromptKind::Hold) return 1;
    if (prompt.kind == PromptKind::Text) return 0;
    return int(prompt.targets.size());
}

AnswerKeys::AnswerKeys(KeySet set, const PilotPrompt& prompt) {
    if (prompt.kind == PromptKind::Hold) return;  // answered by its own key, which has no target among `targets`
    const auto count = std::size_t(targetCount(prompt));
    if (prompt.kind == PromptKind::Scale) {
        for (int value = prompt.least; value <= prompt.most; ++value)
            keys_.push_back(value >= 0 && value <= 9 ? Qt::Key_0 + value : value == 10 ? int(Qt::Key_T) : 0);
        return;
    }
    const auto take = [&](const auto& keys) {
        keys_.assign(keys.begin(), keys.begin() + std::ptrdiff_t(std::min(count, keys.size())));
    };
    if (set == KeySet::LeftHand && count <= kLeftHand.size())
        take(kLeftHand);
    else if (set == KeySet::RightHand && count <= kRightHand.size())
        take(kRightHand);
    else
        take(kFigures);
}

QString AnswerKeys::text(int target) const {
    const auto at = std::size_t(target);
    return target >= 0 && at < keys_.size() && keys_[at] != 0 ? QKeySequence(keys_[at]).toString() : QString();
}

std::optional<int> AnswerKeys::targetOf(int key) const {
    const auto found = key == 0 ? keys_.end() : std::ranges::find(keys_, key);
    return found == keys_.end() ? std::nullopt : std::optional(int(found - keys_.begin()));
}

}  // namespace tacto::gui
