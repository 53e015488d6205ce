// DisplaySight.h - what an X server says of a window beside what Qt knows: which desktop it is on, whether a press on
// it arrives, whether the screen is blank, and whether another program holds keyboard and mouse.
//
// Where the display is not X (Wayland, offscreen) it says nothing of these: those functions return false, and whether a
// window is on the screen is what QWindow::isExposed() says.
//
// Thread-safety: the GUI thread. Each call takes a few exchanges with the server.
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

    /// Whether there is a server to ask.
    [[nodiscard]] bool tells() const { return own_ != nullptr; }
    /// The window manager has the window on a desktop that is not shown (EWMH _NET_WM_DESKTOP).
    [[nodiscard]] bool onAnotherDesktop(const QWidget& window) const;
    /// At less than half of the places within `part`, a visible part of a window of this program, a press would arrive
    /// at this program: what lies on top there is another program's, or a frame, or the screen ends. Windows that let
    /// presses through (an empty input shape) do not count, invisible ones that take them do.
    [[nodiscard]] bool isCovered(const QWidget& part) const;
    /// The server's screen saver shows nothing, or a picture of its own (MIT-SCREEN-SAVER); it does not say whether the
    /// monitor is off (DPMS).
    [[nodiscard]] bool isBlank() const;
    /// Keys go to another program, whichever window has the focus.
    [[nodiscard]] bool keysTakenByAnother() const;
    /// Whether neither a press nor a key reaches a window of this program: it tries to take both, on a connection of
    /// its own, and gives them back at once. What this program itself holds (an open menu, a drag) does not count.
    [[nodiscard]] bool grabbedByAnother() const;

private:
    struct Server;
    std::unique_ptr<Server> own_;
};

}  // namespace tacto::gui
