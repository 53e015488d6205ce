// ScopeOverlay.h - what lies over the traces of an oscilloscope and can be taken hold of: the lanes' zero marks,
// trigger level and moment, cursors with what they read as flags; and what only shows: the zoom box, the width under
// the mouse, pulses that were not measured, and what is said about the whole record.
//
// Draws on a layer of its own, so that moving a cursor does not draw the traces again. It knows nothing of captures:
// the view fills in `state` and asks what lies under the mouse.
#pragma once

#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/scope/screen/ScopePlane.h"

namespace tacto::gui {

enum class Grip { None, Lane, TriggerLevel, TriggerMoment, TimeCursor, LevelCursor };

struct GripAt {
    Grip grip = Grip::None;
    int which = 0;  ///< lane or cursor
};

class ScopeOverlay final : public QCPLayerable {
    Q_OBJECT
public:
    ScopeOverlay(QCPAxis* keyAxis, QCPAxis* valueAxis);
    OverlayState state;

    [[nodiscard]] GripAt at(const QPointF& pixel) const;

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override;
    void draw(QCPPainter* painter) override;
    QRect clipRect() const override;

private:
    [[nodiscard]] Pennant lanePennant(int lane) const;
    [[nodiscard]] Pennant triggerPennant() const;
    [[nodiscard]] Pennant levelTag(int cursor) const;
    /// The train that comes next over the last one: dashed, with what it will be.
    void drawComing(QCPPainter& painter) const;
    void drawLevelCursors(QCPPainter& painter) const;
    void drawTrigger(QCPPainter& painter) const;
    void drawMarks(QCPPainter& painter) const;
    void drawMoments(QCPPainter& painter) const;
    void drawHover(QCPPainter& painter) const;
    void drawNotes(QCPPainter& painter) const;
    void drawAlarm(QCPPainter& painter) const;

    ScopePlane plane_;
};

}  // namespace tacto::gui
