#include "app/gui/window/Attendance.h"

#include <QGuiApplication>
#include <QScreen>
#include <QWindow>

namespace tacto::gui {

namespace {

constexpr int kAskDisplayEvery_ms = 200;

/// True if at least half of the widget's area is on a screen.
bool isOnScreen(const QWidget& widget) {
    const QRect place(widget.mapToGlobal(QPoint()), widget.size());
    const auto areaOf = [](const QRect& part) { return part.isEmpty() ? 0.0 : double(part.width()) * part.height(); };
    double shown = 0;
    for (const auto* screen : QGuiApplication::screens()) shown += areaOf(screen->geometry() & place);
    return 2 * shown >= areaOf(place);
}

}  // namespace

/// Asks the X server what Qt does not know. Some window managers also call windows on another desktop minimised.
QString Attendance::askDisplay(const StopInSight& shown) {
    coveredNow_ = false;
    if (display_.onAnotherDesktop(shown.window)) return QObject::tr("this window was on another desktop");
    if (display_.grabbedByAnother()) return QObject::tr("another program held the keyboard and the mouse");
    if (display_.isBlank()) return QObject::tr("the screen was blank");
    if (window_.isMinimized() || !shown.window.windowHandle()->isExposed() || !isOnScreen(shown.stop)) return {};
    coveredNow_ = display_.isCovered(shown.stop);
    const bool another = shown.small != nullptr && !display_.isCovered(*shown.small);
    if (!coveredNow_ || another) return {};
    const bool keys = QGuiApplication::applicationState() == Qt::ApplicationActive && !display_.keysTakenByAnother();
    return keys ? QString() : QObject::tr("another program’s window lay over this one");
}

QString Attendance::reason(const StopInSight& shown, bool outputOn) {
    // A window that was never shown cannot be out of sight.
    const bool isShown = shown.window.windowHandle() != nullptr && shown.window.isVisible();
    if (!isShown || !outputOn) {
        ofDisplay_.clear();
        coveredNow_ = false;
        asked_.invalidate();
    } else if (!asked_.isValid() || asked_.elapsed() >= kAskDisplayEvery_ms) {
        asked_.start();
        ofDisplay_ = askDisplay(shown);
    }
    if (!ofDisplay_.isEmpty()) return ofDisplay_;
    if (window_.isMinimized()) return QObject::tr("this window was minimised");
    if (const auto locked = lock_.says(); !locked.isEmpty()) return locked;
    if (!isShown) return {};
    if (display_.tells() && !isOnScreen(shown.stop)) return QObject::tr("STOP was beyond the edge of the screen");
    return shown.window.windowHandle()->isExposed() ? QString() : QObject::tr("this window was not on the screen");
}

void Attendance::noteCover() {
    if (coveredNow_ == covered_) return turned_.invalidate();
    if (!turned_.isValid()) turned_.start();
    if (turned_.elapsed() >= (coveredNow_ ? kCovered_ms : kUncovered_ms)) covered_ = coveredNow_;
}

QString Attendance::absence(const StopInSight& shown, bool outputOn) {
    const auto why = reason(shown, outputOn);
    noteCover();
    if (why.isEmpty()) {
        since_.invalidate();
        return {};
    }
    if (!since_.isValid()) since_.start();
    return since_.elapsed() >= kAbsent_ms ? why : QString();
}

}  // namespace tacto::gui
