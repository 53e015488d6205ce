// ScopeGestures.h - turns mouse and key input on a ScopeScreen into changes of its ScopeModel.
//
// Mouse: the wheel zooms time, Ctrl+wheel the level of the active lane, Shift+wheel pans. Dragging pans, or moves a
// handle; Shift+drag (or the box tool) zooms into a box; a double click fits; a click on a trace activates its lane.
// Keys: arrows nudge the focused cursor, or pan if there is none; + and - zoom, Home fits, Ctrl+Z undoes a zoom, 1 to 4
// focus a cursor.
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
    /// True: the next drag draws a box, to which the screen then zooms.
    void setBoxZoom(bool on);

signals:
    void boxZoomEnded();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// What a drag with the mouse does.
    enum class Drag { None, Undecided, Pan, Box, Grip };

    void press(const QMouseEvent& event);
    void move(const QPointF& pixel);
    void release(const QMouseEvent& event);
    void turn(const QWheelEvent& event);
    /// Returns true if the key has a function here.
    [[nodiscard]] bool keyPressed(const QKeyEvent& event);
    void nudge(int key, Qt::KeyboardModifiers modifiers);
    void zoomByKey(int steps, bool level);
    void dragGrip(const QPointF& pixel);
    void endBox();
    void hover(const QPointF& pixel);
    /// The key of the lane at whose handle the mouse button went down; empty if there is none.
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
