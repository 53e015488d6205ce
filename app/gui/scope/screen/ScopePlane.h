// ScopePlane.h - converts times and heights on the oscilloscope's screen to pixels, and draws lines, words and pennants
// over the traces.
#pragma once

#include <qcustomplot.h>

namespace tacto::gui {

/// A handle at an edge, with its word inside `box`.
struct Pennant {
    QRectF box;
    QPolygonF shape;
};

class ScopePlane {
public:
    /// The axes outlive this; they are in seconds and in divisions above the middle.
    ScopePlane(QCPAxis* keyAxis, QCPAxis* valueAxis) : keys_(keyAxis), values_(valueAxis) {}

    [[nodiscard]] QRectF area() const;
    [[nodiscard]] double x(double key_s) const;
    [[nodiscard]] double y(double height) const;
    [[nodiscard]] QFont font() const;

    /// Kept inside the area, so that the user can drag it back from beyond the edge.
    [[nodiscard]] Pennant pennant(Qt::Edge edge, double along, const QString& text) const;
    /// The box of a word, moved left or right to stay inside the area.
    [[nodiscard]] QRectF tagBox(const QPointF& centre, const QString& text) const;

    void drawLine(QCPPainter& painter, const QLineF& line, const QColor& colour, Qt::PenStyle style) const;
    void drawPennant(QCPPainter& painter, const Pennant& pennant, const QString& text, const QColor& colour,
                     bool filled) const;
    /// The background colour of words over the traces.
    [[nodiscard]] static QColor ground();
    void drawTag(QCPPainter& painter, const QPointF& centre, const QString& text, const QColor& colour) const;

private:
    QCPAxis* keys_;
    QCPAxis* values_;
};

}  // namespace tacto::gui
