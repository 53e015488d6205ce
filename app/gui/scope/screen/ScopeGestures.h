// ScopeGestures.h - what mouse and keys on a ScopeScreen do to its ScopeModel.
//
// Mouse: the wheel zooms time, Ctrl+wheel the level of the active lane, Shift+wheel pans; dragging pans, Shift+drag (or
// the box tool) zooms into a box, a double click fits, handles are dragged, a click on a trace makes its lane active.
// Keys: arrows nudge the focused cursor, or pan without one; + and - zoom, Home fits, Ctrl+Z goes back, 1 to 4 focus a
// cursor.
#pragma once

#include <QObject>
#include <QPointF>

#include "app/gui/scope/screen/ScopeScreen.h"

namespace tacto::gui {

class ScopeGestures final : public QObject {
    Q_OBJECT
public:
    /// Both arguments outlive this.
    ScopeGestures(ScopeModel& model, ScopeScreen& screen);
    /// The next drag draws a box that becomes the whole screen.
    void setBoxZoom(bool on);

signals:
    void boxZoomEnded();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// The effect of dragging with the mouse.
    enum class Drag { None, Undecided, Pan, Box, Grip };

    void press(const QMouseEvent& event);
    void move(const QPointF& pixel);
    void release(const QMouseEvent& event);
    void turn(const QWheelEvent& event);
    /// Returns whether the key means something here.
    [[nodiscard]] bool keyPressed(const QKeyEvent& event);
    void nudge(int key, Qt::KeyboardModifiers modifiers);
    void zoomByKey(int steps, bool level);
    void dragGrip(const QPointF& pixel);
    void endBox();
    void hover(const QPointF& pixel);
    /// The lane whose letter is the overlay's number so-and-so; empty without one.
    [[nodiscard]] QString gripLane() const;

    ScopeModel& model_;
    ScopeScreen& screen_;
    bool boxZoom_ = false;
    Drag drag_ = Drag::None;
    GripAt grip_;
    QPointF pressedAt_;
    Viewport pressedView_;
};

}  // namespace tacto::gui
