// Attendance.h - whether the operator can see STOP and reach it: not while the window is minimised, on another desktop
// or off the screen, the screen is locked or blank, another program holds keyboard and mouse, or its windows lie over
// each STOP while it has the keys (hazards H2, H12).
//
// What of this the display does not tell is not known, and then it does not count: see DisplaySight and LockWatch, and
// safety.md "Interlock".
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QWidget>

#include "app/gui/window/DisplaySight.h"
#include "app/gui/window/LockWatch.h"

namespace tacto::gui {

struct StopInSight {
    const QWidget& window;           ///< a window that has to be on the screen
    const QWidget& stop;             ///< STOP in that window
    const QWidget* small = nullptr;  ///< STOP by itself; null: it is not shown
};

class Attendance final : public QObject {
public:
    /// How long STOP has to be out of reach before output pauses: a glance at another desktop, or a window that is
    /// dragged, does not count.
    static constexpr int kAbsent_ms = 1500;
    /// How long another program's window has to lie over STOP before that counts, and how long it has to be gone.
    static constexpr int kCovered_ms = 500, kUncovered_ms = 2000;

    explicit Attendance(QWidget& window) : QObject(&window), window_(window), lock_(this) {}
    /// Called thirty times a second, in every state of the output; the display is asked while it is on. Returns why
    /// STOP has been out of reach for kAbsent_ms ("this window was minimised": read when it no longer is); empty while
    /// it is in reach.
    [[nodiscard]] QString absence(const StopInSight& shown, bool outputOn);
    /// Whether another program's window lies over STOP while output is on, whatever else is in reach.
    [[nodiscard]] bool isCovered() const { return covered_; }
    /// Whether desktops, grabs and what lies on top are known.
    [[nodiscard]] bool displayTells() const { return display_.tells(); }
    /// The operator has resumed by hand.
    void noteHand() { lock_.forget(); }

private:
    [[nodiscard]] QString askDisplay(const StopInSight& shown);
    [[nodiscard]] QString reason(const StopInSight& shown, bool outputOn);
    void noteCover();

    QWidget& window_;
    DisplaySight display_;
    LockWatch lock_;
    QElapsedTimer asked_;  // the display
    QString ofDisplay_;    // what the display answered last
    QElapsedTimer since_;  // invalid while STOP is in reach
    bool coveredNow_ = false, covered_ = false;
    QElapsedTimer turned_;  // how long the two have differed
};

}  // namespace tacto::gui
