#include "app/gui/window/WindowPlace.h"

#include <QScreen>
#include <QSplitter>
#include <QWidget>
#include <algorithm>

namespace tacto::gui {

void keepOnScreen(QWidget& window) {
    if (window.isMaximized() || window.isFullScreen()) return;
    const auto room = window.screen()->availableGeometry();
    const auto frame = window.frameGeometry().size() - window.geometry().size();
    window.resize(window.size().boundedTo(room.size() - frame));
    auto place = window.frameGeometry();
    place.moveRight(std::min(place.right(), room.right()));
    place.moveBottom(std::min(place.bottom(), room.bottom()));
    place.moveLeft(std::max(place.left(), room.left()));
    place.moveTop(std::max(place.top(), room.top()));
    if (place.topLeft() != window.frameGeometry().topLeft()) window.move(place.topLeft());
}

void layOutAnew(QSplitter& splitter) {
    const bool across = splitter.orientation() == Qt::Horizontal;
    const int count = splitter.count();
    QList<int> sizes, stretches;
    int left = across ? splitter.width() : splitter.height(), shares = 0;
    for (int i = 0; i < count; ++i) {
        const auto* part = splitter.widget(i);
        const auto policy = part->sizePolicy();
        const auto wanted = part->sizeHint().expandedTo(part->minimumSizeHint()).expandedTo(part->minimumSize());
        sizes << std::max(0, across ? wanted.width() : wanted.height());
        stretches << (across ? policy.horizontalStretch() : policy.verticalStretch());
        left -= sizes.back();
        shares += stretches.back();
    }
    for (int i = 0; i < count && left > 0; ++i) sizes[i] += shares > 0 ? left * stretches[i] / shares : left / count;
    splitter.setSizes(sizes);
}

}  // namespace tacto::gui
