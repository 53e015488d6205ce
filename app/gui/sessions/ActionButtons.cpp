#include "app/gui/sessions/ActionButtons.h"

#include <algorithm>
#include <utility>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kWordsFrom = 1020;  // pixels for both panes
}

QPushButton* ActionButtons::add(QBoxLayout& row, const char* iconName, const QString& text, const QString& tip,
                                std::function<void()> act) {
    auto* button = new QPushButton(icon(iconName), text, row.parentWidget());
    button->setAutoDefault(false);
    button->setAccessibleName(QString(text).remove('&'));
    QObject::connect(button, &QPushButton::clicked, button, std::move(act));
    row.addWidget(button);
    all_.push_back({button, text, tip, {}});
    explain(all_.back());
    return button;
}

void ActionButtons::explain(const Action& action) {
    const auto& says = action.refusal.isEmpty() ? action.tip : action.refusal;
    action.button->setToolTip(
        action.button->text().isEmpty() ? QString("%1: %2").arg(action.button->accessibleName(), says) : says);
}

void ActionButtons::offer(QPushButton* button, const QString& refusal) {
    const auto action = std::ranges::find(all_, button, &Action::button);
    action->refusal = refusal;
    button->setEnabled(refusal.isEmpty());
    explain(*action);
}

void ActionButtons::offerAll(const QString& refusal) {
    for (auto& action : all_) offer(action.button, refusal);
}

void ActionButtons::dress(int room) {
    const bool worded = room >= scaledPx(kWordsFrom);
    for (const auto& action : all_) {
        action.button->setText(worded ? action.text : QString());
        explain(action);
    }
}

}  // namespace tacto::gui
