// Attendance.h - checks that the operator can see and reach STOP. This is not so if the window is minimised, on another
// desktop or off the screen, if the screen is locked or blank, if another program holds keyboard and mouse, or if
// another program has the keys and its windows cover each STOP (hazards H2, H12).
//
// What the display does not report is unknown and never makes STOP count as out of reach: see DisplaySight and
// LockWatch, and safety.md "Interlock".
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
    const QWidget* small = nullptr;  ///< STOP in its small window; null: not shown
};

class Attendance final : public QObject {
public:
    /// How long STOP must be out of reach before output pauses. A glance at another desktop or a dragged window is
    /// shorter.
    static constexpr int kAbsent_ms = 1500;
    /// How long another program's window must cover STOP until covered_ is true, and leave STOP free until it is false.
    static constexpr int kCovered_ms = 500, kUncovered_ms = 2000;

    explicit Attendance(QWidget& window) : QObject(&window), window_(window), lock_(this) {}
    /// Called 30 times a second while output can flow, and more seldom otherwise; asks the display only while it is on.
    /// Returns why STOP has been out of reach for kAbsent_ms ("this window was minimised": in the past tense, because
    /// the operator reads it afterwards); empty while STOP is in reach.
    [[nodiscard]] QString absence(const StopInSight& shown, bool outputOn);
    /// True if another program's window covers STOP while output is on, even if another STOP is in reach.
    [[nodiscard]] bool isCovered() const { return covered_; }
    /// True if the display reports desktops, grabs and covering windows.
    [[nodiscard]] bool displayTells() const { return display_.tells(); }
    /// Call this after the operator has resumed by hand.
    void noteHand() { lock_.forget(); }

private:
    [[nodiscard]] QString askDisplay(const StopInSight& shown);
    [[nodiscard]] QString reason(const StopInSight& shown, bool outputOn);
    void noteCover();

    QWidget& window_;
    DisplaySight display_;
    LockWatch lock_;
    QElapsedTimer asked_;  // time since the display was asked
    QString ofDisplay_;    // the display's last answer
    QElapsedTimer since_;  // time since STOP went out of reach; invalid while it is in reach
    bool coveredNow_ = false, covered_ = false;
    QElapsedTimer turned_;  // how long coveredNow_ has differed from covered_
};

}  // namespace tacto::gui
