#include "app/gui/theme/TurningRow.h"

#include <algorithm>

namespace tacto::gui {

void TurningRow::setGeometry(const QRect& room) {
    const bool beside = room.width() >= from();
    if (beside != (direction() == LeftToRight)) {
        setDirection(beside ? LeftToRight : TopToBottom);
        emit turned(beside);
    }
    QBoxLayout::setGeometry(room);
}

int TurningRow::from() const {
    if (from_) return from_();
    int all = 0, parts = 0;
    for (int at = 0; at < count(); ++at) {
        if (itemAt(at)->isEmpty()) continue;
        all += itemAt(at)->sizeHint().width();
        ++parts;
    }
    return all + std::max(0, parts - 1) * spacing();
}

QSize TurningRow::sizeHint() const {
    const auto hint = QBoxLayout::sizeHint();
    return {std::max(hint.width(), from()), hint.height()};
}

QSize TurningRow::minimumSize() const {
    int widest = 0;
    for (int at = 0; at < count(); ++at)
        if (!itemAt(at)->isEmpty()) widest = std::max(widest, itemAt(at)->minimumSize().width());
    const auto margins = contentsMargins();
    return {widest + margins.left() + margins.right(), QBoxLayout::minimumSize().height()};
}

}  // namespace tacto::gui

#include "moc_TurningRow.cpp"
