#include "app/gui/theme/TurningRow.h"

namespace tacto::gui {

void TurningRow::setGeometry(const QRect& room) {
    const bool beside = room.width() >= from_();
    if (beside != (direction() == LeftToRight)) {
        setDirection(beside ? LeftToRight : TopToBottom);
        emit turned(beside);
    }
    QBoxLayout::setGeometry(room);
}

}  // namespace tacto::gui

#include "moc_TurningRow.cpp"
