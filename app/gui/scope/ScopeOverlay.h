// ScopeOverlay.h - what lies over the traces of an oscilloscope and can be taken hold of: the lanes' zero marks,
// trigger level and moment, cursors with what they read as flags; and what only shows: the zoom box, the width under
// the mouse, pulses that were not measured, and what is said of the whole record.
//
// Draws on a layer of its own, so that moving a cursor does not draw the traces again. It knows nothing of captures:
// the view fills in `state` and asks what lies under the mouse.
//
// Thread-safety: the GUI thread.
#pragma once

#include <optional>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/scope/TraceEdges.h"

namespace tacto::gui {

enum class Grip { None, Lane, TriggerLevel, TriggerMoment, TimeCursor, LevelCursor };

struct GripAt {
    Grip grip = Grip::None;
    int which = 0;  ///< lane or cursor
};

/// Times in seconds on the key axis, heights in divisions above the middle.
struct OverlayState {
    struct Lane {
        QString key;
        QString letter;  ///< "V"
        QColor colour;
        double height = 0;
        bool active = false;
    };
    struct Trigger {
        std::optional<double> height;  ///< nothing: its channel is not shown
        std::optional<double> moment_s;
        QColor colour;
        bool held = false;  ///< the level follows the command and cannot be dragged
        QString text;       ///< while it is dragged
    };
    struct Mark {
        double from_s = 0, to_s = 0;
        QString why;
        QColor colour;
    };
    /// What the operator marked.
    struct Moment {
        double at_s = 0;
        QString word;
    };
    /// A stretch of a trace, from its lowest to its highest.
    struct Drawn {
        double from_s = 0, to_s = 0;
        double low = 0, high = 0;
    };
    /// What a cursor reads; it stands where it hides least of the traces: beyond what the two
    /// cursors enclose, unless there is much more room between them.
    struct Flag {
        struct Row {
            QString letter;  ///< of the lane
            QString text;    ///< "20.1 V ↑"
            QColor colour;
        };
        QString name;      ///< "t₁"
        QString position;  ///< "200.0 µs"
        std::vector<Row> rows;
    };
    std::vector<Lane> lanes;
    std::optional<Trigger> trigger;
    std::vector<double> timeCursors_s;  ///< two or none
    std::vector<Flag> flags;            ///< of the time cursors
    QString timeSpan;                   ///< between them
    std::vector<Drawn> drawn;           ///< of the lanes shown, with time cursors
    std::vector<double> levelCursors;   ///< two or none, heights
    std::vector<QString> levelTexts;    ///< of the level cursors: "y₁ 40.0 V"
    QString levelSpan;                  ///< between them
    int focusedCursor = -1;             ///< 0, 1: time; 2, 3: level
    std::optional<QRectF> box;          ///< pixels
    std::optional<EdgeReading> hover;
    std::vector<Mark> marks;  ///< in time order
    std::vector<Moment> moments;
    QStringList notes;  ///< about the whole record: "not triggered", "averaged 16"
    QString alarm;      ///< of a failed mask test, until it is acknowledged
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
    struct Pennant {
        QRectF box;
        QPolygonF shape;
    };
    [[nodiscard]] QFont font() const;
    [[nodiscard]] QRectF area() const { return QRectF(keys_->axisRect()->rect()); }
    [[nodiscard]] double x(double key_s) const;
    [[nodiscard]] double y(double height) const;
    /// Held inside the area, so that what is off the screen can be fetched back.
    [[nodiscard]] Pennant pennant(Qt::Edge edge, double along, const QString& text) const;
    [[nodiscard]] Pennant lanePennant(int lane) const;
    /// In the order of the cursors; empty without them.
    [[nodiscard]] std::vector<QRectF> flagBoxes() const;
    /// What the traces cover, in pixels.
    [[nodiscard]] std::vector<QRectF> drawnBoxes() const;
    /// Where the words between the time cursors stand.
    [[nodiscard]] QRectF spanBox(const std::vector<QRectF>& drawn) const;
    [[nodiscard]] QRectF tagBox(const QPointF& centre, const QString& text) const;
    [[nodiscard]] QSizeF sizeOf(const OverlayState::Flag& flag) const;
    [[nodiscard]] Pennant levelTag(int cursor) const;
    void drawFlag(QCPPainter& painter, const QRectF& box, const OverlayState::Flag& flag, bool focused) const;
    void drawTimeCursors(QCPPainter& painter) const;
    void drawLevelCursors(QCPPainter& painter) const;
    void drawPennant(QCPPainter& painter, const Pennant& pennant, const QString& text, const QColor& colour,
                     bool filled) const;
    void drawLine(QCPPainter& painter, const QLineF& line, const QColor& colour, Qt::PenStyle style) const;
    void drawTrigger(QCPPainter& painter) const;
    void drawMarks(QCPPainter& painter) const;
    void drawMoments(QCPPainter& painter) const;
    void drawHover(QCPPainter& painter) const;
    void drawNotes(QCPPainter& painter) const;
    void drawAlarm(QCPPainter& painter) const;
    void drawTag(QCPPainter& painter, const QPointF& centre, const QString& text, const QColor& colour) const;

    QCPAxis* keys_;
    QCPAxis* values_;
};

}  // namespace tacto::gui
