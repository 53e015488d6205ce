// ScopePlane.h - the plane of an oscilloscope's screen in pixels: where times and heights lie, and how lines, words and
// pennants are drawn over the traces.
#pragma once

#include <qcustomplot.h>

namespace tacto::gui {

/// A handle at an edge, its word in `box`.
struct Pennant {
    QRectF box;
    QPolygonF shape;
};

class ScopePlane {
public:
    /// The axes outlive it: times in seconds, heights in divisions above the middle.
    ScopePlane(QCPAxis* keyAxis, QCPAxis* valueAxis) : keys_(keyAxis), values_(valueAxis) {}

    [[nodiscard]] QRectF area() const;
    [[nodiscard]] double x(double key_s) const;
    [[nodiscard]] double y(double height) const;
    [[nodiscard]] QFont font() const;

    /// Held inside the area, so that what is off the screen can be fetched back.
    [[nodiscard]] Pennant pennant(Qt::Edge edge, double along, const QString& text) const;
    /// The box of a word, held inside the area from left to right.
    [[nodiscard]] QRectF tagBox(const QPointF& centre, const QString& text) const;

    void drawLine(QCPPainter& painter, const QLineF& line, const QColor& colour, Qt::PenStyle style) const;
    void drawPennant(QCPPainter& painter, const Pennant& pennant, const QString& text, const QColor& colour,
                     bool filled) const;
    /// The ground below words over the traces.
    [[nodiscard]] static QColor ground();
    void drawTag(QCPPainter& painter, const QPointF& centre, const QString& text, const QColor& colour) const;

private:
    QCPAxis* keys_;
    QCPAxis* values_;
};

}  // namespace tacto::gui
