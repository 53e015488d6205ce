#include "app/gui/window/WindowPlace.h"

#include <QScreen>
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

}  // namespace tacto::gui
