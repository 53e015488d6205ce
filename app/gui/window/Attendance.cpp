#include "app/gui/window/Attendance.h"

#include <QGuiApplication>
#include <QScreen>
#include <QWindow>
#include <algorithm>

namespace tacto::gui {

namespace {

constexpr int kAskDisplayEvery_ms = 200;

bool isOnScreen(const QWidget& widget) {
    const QRect place(widget.mapToGlobal(QPoint()), widget.size());
    return std::ranges::any_of(QGuiApplication::screens(),
                               [&](const QScreen* screen) { return screen->geometry().intersects(place); });
}

}  // namespace

/// What the server has to be asked for. Some window managers call what is on another desktop minimised, too.
QString Attendance::askDisplay(const QWidget& shown) const {
    if (display_.onAnotherDesktop(shown)) return QObject::tr("this window is on another desktop");
    if (display_.grabbedByAnother()) return QObject::tr("another program holds the keyboard and the mouse");
    return {};
}

QString Attendance::reason(const QWidget& shown, bool outputOn) {
    // One that was never shown claims nothing of a screen.
    const bool isShown = shown.windowHandle() != nullptr && shown.isVisible();
    if (!isShown || !outputOn) {
        ofDisplay_.clear();
        asked_.invalidate();
    } else if (!asked_.isValid() || asked_.elapsed() >= kAskDisplayEvery_ms) {
        asked_.start();
        ofDisplay_ = askDisplay(shown);
    }
    if (!ofDisplay_.isEmpty()) return ofDisplay_;
    if (window_.isMinimized()) return QObject::tr("this window is minimised");
    if (const auto locked = lock_.says(); !locked.isEmpty()) return locked;
    if (!isShown) return {};
    if (display_.tells() && &shown == &window_ && !isOnScreen(stop_))
        return QObject::tr("STOP is beyond the edge of the screen");
    return shown.windowHandle()->isExposed() ? QString() : QObject::tr("this window is not on the screen");
}

QString Attendance::absence(const QWidget& shown, bool outputOn) {
    const auto why = reason(shown, outputOn);
    if (why.isEmpty()) {
        since_.invalidate();
        return {};
    }
    if (!since_.isValid()) since_.start();
    return since_.elapsed() >= kAbsent_ms ? why : QString();
}

}  // namespace tacto::gui
