#include "app/gui/scope/screen/ScopePlane.h"

#include <algorithm>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

QRectF ScopePlane::area() const { return QRectF(keys_->axisRect()->rect()); }

QFont ScopePlane::font() const { return textFont(TextSize::Small); }

double ScopePlane::x(double key_s) const {
    const auto range = keys_->range();
    return area().left() + (key_s - range.lower) / range.size() * area().width();
}

double ScopePlane::y(double height) const {
    const auto range = values_->range();
    return area().bottom() - (height - range.lower) / range.size() * area().height();
}

Pennant ScopePlane::pennant(Qt::Edge edge, double along, const QString& text) const {
    const QFontMetricsF metrics(font());
    const double h = metrics.height() + 2;
    const double w = metrics.horizontalAdvance(text) + h * 0.5;
    const double tip = h * 0.35;
    const auto a = area();
    Pennant p;
    if (edge == Qt::LeftEdge || edge == Qt::RightEdge) {
        const double yMid = std::clamp(along, a.top() + h / 2, a.bottom() - h / 2);
        const bool left = edge == Qt::LeftEdge;
        const double x0 = left ? a.left() : a.right();
        const double sign = left ? 1 : -1;
        p.box = QRectF(left ? x0 : x0 - w, yMid - h / 2, w, h);
        p.shape << QPointF(x0, yMid - h / 2) << QPointF(x0 + sign * w, yMid - h / 2)
                << QPointF(x0 + sign * (w + tip), yMid) << QPointF(x0 + sign * w, yMid + h / 2)
                << QPointF(x0, yMid + h / 2);
    } else {
        const double xMid = std::clamp(along, a.left() + w / 2, a.right() - w / 2);
        const bool top = edge == Qt::TopEdge;
        const double y0 = top ? a.top() : a.bottom();
        const double sign = top ? 1 : -1;
        p.box = QRectF(xMid - w / 2, top ? y0 : y0 - h, w, h);
        p.shape << QPointF(xMid - w / 2, y0) << QPointF(xMid + w / 2, y0) << QPointF(xMid + w / 2, y0 + sign * h)
                << QPointF(xMid, y0 + sign * (h + tip)) << QPointF(xMid - w / 2, y0 + sign * h);
    }
    return p;
}

void ScopePlane::drawLine(QCPPainter& painter, const QLineF& line, const QColor& colour, Qt::PenStyle style) const {
    painter.setPen(QPen(colour, 1, style));
    painter.drawLine(line);
}

void ScopePlane::drawPennant(QCPPainter& painter, const Pennant& pennant, const QString& text, const QColor& colour,
                             bool filled) const {
    painter.setPen(QPen(colour, 1));
    painter.setBrush(filled ? colour : colours().base);
    painter.setAntialiasing(true);
    painter.drawPolygon(pennant.shape);
    painter.setAntialiasing(false);
    painter.setPen(filled ? colours().base : colour);
    painter.drawText(pennant.box, Qt::AlignCenter, text);
}

QColor ScopePlane::ground() {
    auto ground = colours().base;
    ground.setAlpha(225);
    return ground;
}

QRectF ScopePlane::tagBox(const QPointF& centre, const QString& text) const {
    const QFontMetricsF metrics(font());
    const auto a = area();
    QRectF box(0, 0, metrics.horizontalAdvance(text) + 12, metrics.height() + 4);
    box.moveCenter(centre);
    box.moveLeft(std::clamp(box.left(), a.left() + 2, std::max(a.left() + 2, a.right() - box.width() - 2)));
    return box;
}

void ScopePlane::drawTag(QCPPainter& painter, const QPointF& centre, const QString& text, const QColor& colour) const {
    const auto box = tagBox(centre, text);
    painter.setPen(QPen(colours().grid, 1));
    painter.setBrush(ground());
    painter.drawRect(box);
    painter.setPen(colour);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace tacto::gui
