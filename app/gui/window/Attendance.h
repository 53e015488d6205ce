// Attendance.h - whether the operator can see STOP and reach it: not while the window is minimised, on another desktop
// or off the screen, the screen is locked, or another program holds keyboard and mouse (hazards H2, H12).
//
// What of this the display does not tell is not known, and then it does not count: see DisplaySight and LockWatch, and
// safety.md "Interlock".
//
// Thread-safety: the GUI thread.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QWidget>

#include "app/gui/window/DisplaySight.h"
#include "app/gui/window/LockWatch.h"

namespace tacto::gui {

class Attendance final : public QObject {
public:
    /// How long STOP has to be out of reach before output pauses: a glance at another desktop, or a window that is
    /// dragged, does not count.
    static constexpr int kAbsent_ms = 1500;

    /// `stop` stands in `window`.
    Attendance(QWidget& window, const QWidget& stop) : QObject(&window), window_(window), stop_(stop), lock_(this) {}
    /// Thirty times a second, in every state of the output; the display is asked while it is on. `shown`: the window
    /// that has to be on the screen. Returns why STOP has been out of reach for kAbsent_ms ("this window is
    /// minimised"); empty while it is in reach.
    [[nodiscard]] QString absence(const QWidget& shown, bool outputOn);
    /// Whether desktops and grabs are known.
    [[nodiscard]] bool displayTells() const { return display_.tells(); }
    /// The operator has gone on by hand.
    void noteHand() { lock_.forget(); }

private:
    [[nodiscard]] QString askDisplay(const QWidget& shown) const;
    [[nodiscard]] QString reason(const QWidget& shown, bool outputOn);

    QWidget& window_;
    const QWidget& stop_;
    DisplaySight display_;
    LockWatch lock_;
    QElapsedTimer asked_;  // the display
    QString ofDisplay_;    // its last answer
    QElapsedTimer since_;  // invalid while STOP is in reach
};

}  // namespace tacto::gui
