// ScopeOverlay.h - draws everything over the oscilloscope's traces. The mouse can grip the lanes' zero marks, the
// trigger's level and moment, and the cursors with their flags. Only shown are the zoom box, the width under the mouse,
// pulses that were not measured, and notes about the whole record.
//
// Draws on a separate layer, so that moving a cursor does not redraw the traces. Has no access to captures: the view
// fills in `state` and asks what is under the mouse.
#pragma once

#include "app/gui/scope/screen/OverlayState.h"
#include "app/gui/scope/screen/ScopePlane.h"

namespace tacto::gui {

enum class Grip { None, Lane, TriggerLevel, TriggerMoment, TimeCursor, LevelCursor };

struct GripAt {
    Grip grip = Grip::None;
    int which = 0;  ///< index of the lane or cursor; of a trigger's level 1 for a runt's other threshold
};

class ScopeOverlay final : public QCPLayerable {
    Q_OBJECT
public:
    ScopeOverlay(QCPAxis* keyAxis, QCPAxis* valueAxis);
    OverlayState state;

    [[nodiscard]] GripAt at(const QPointF& pixel) const;
    /// The room that an alarm needs above the traces, in pixels.
    [[nodiscard]] static int alarmHeight();

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override;
    void draw(QCPPainter* painter) override;
    QRect clipRect() const override;

private:
    [[nodiscard]] Pennant lanePennant(int lane) const;
    [[nodiscard]] Pennant triggerPennant(double height, const QString& text) const;
    [[nodiscard]] Pennant levelTag(int cursor) const;
    /// Draws the coming train over the last one: dashed, with its description.
    void drawComing(QCPPainter& painter) const;
    void drawLevelCursors(QCPPainter& painter) const;
    void drawTrigger(QCPPainter& painter) const;
    void drawWidthWindow(QCPPainter& painter, const std::pair<double, double>& began_s) const;
    void drawMarks(QCPPainter& painter) const;
    void drawMoments(QCPPainter& painter) const;
    void drawHover(QCPPainter& painter) const;
    void drawNotes(QCPPainter& painter) const;
    void drawAlarm(QCPPainter& painter) const;

    ScopePlane plane_;
};

}  // namespace tacto::gui
