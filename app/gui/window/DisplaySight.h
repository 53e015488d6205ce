// DisplaySight.h - asks the X server what Qt does not know about a window: its desktop, whether a press on the window
// arrives, whether the screen is blank, and whether another program holds keyboard and mouse.
//
// Without an X server (Wayland, offscreen) nothing of this is known and these functions return false. Only
// QWindow::isExposed() then says whether a window is on the screen.
//
// Thread-safety: the GUI thread. Each call exchanges a few messages with the server.
#pragma once

#include <memory>

class QWidget;

namespace tacto::gui {

class DisplaySight {
public:
    DisplaySight();
    ~DisplaySight();
    DisplaySight(const DisplaySight&) = delete;
    DisplaySight& operator=(const DisplaySight&) = delete;

    /// True if there is an X server to ask.
    [[nodiscard]] bool tells() const { return own_ != nullptr; }
    /// True if the window manager has the window on a hidden desktop (EWMH _NET_WM_DESKTOP).
    [[nodiscard]] bool onAnotherDesktop(const QWidget& window) const;
    /// True if a press would arrive at this program at less than half of the points tested in `part`, a visible part of
    /// its window: elsewhere another program's window or a frame lies on top, or the screen ends. Ignores windows that
    /// let presses through (empty input shape), but not invisible windows that take presses.
    [[nodiscard]] bool isCovered(const QWidget& part) const;
    /// True if the server's screen saver shows nothing or its own picture (MIT-SCREEN-SAVER). Does not know whether the
    /// monitor is off (DPMS).
    [[nodiscard]] bool isBlank() const;
    /// True if keys go to another program, whichever window has the focus.
    [[nodiscard]] bool keysTakenByAnother() const;
    /// True if neither presses nor keys can reach a window of this program: tries to grab both on a separate connection
    /// and releases them at once. Grabs of this program itself (an open menu, a drag) are ignored.
    [[nodiscard]] bool grabbedByAnother() const;

private:
    struct Server;
    std::unique_ptr<Server> own_;
};

}  // namespace tacto::gui
