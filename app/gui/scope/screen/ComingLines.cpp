#include "app/gui/scope/screen/ComingLines.h"

#include <algorithm>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kComingWidth = 2;  // pixels

QFont comingFont() { return textFont(TextSize::Small, QFont::DemiBold); }

}  // namespace

QRectF ComingLines::wordsBox(const OverlayState::Coming& coming) const {
    const QFontMetricsF metrics(comingFont());
    const auto a = plane_.area();
    double top = a.bottom();
    for (const auto& point : coming.line) top = std::min(top, plane_.y(point.y()));
    QRectF box(0, 0, metrics.horizontalAdvance(coming.text) + 4, metrics.height());
    box.moveBottomLeft(QPointF(plane_.x(0) + kComingWidth, top - kComingWidth));
    box.moveLeft(std::clamp(box.left(), a.left(), std::max(a.left(), a.right() - box.width())));
    box.moveTop(std::clamp(box.top(), a.top(), std::max(a.top(), a.bottom() - box.height())));
    return box;
}

void ComingLines::draw(QCPPainter& painter) const {
    const auto a = plane_.area();
    for (const auto& coming : state_.coming) {
        QPolygonF line;
        for (const auto& point : coming.line) {
            // Qt draws no dashes of a line that goes a million pixels beyond its device.
            line << QPointF(std::clamp(plane_.x(point.x()), a.left() - 4, a.right() + 4),
                            std::clamp(plane_.y(point.y()), a.top() - 4, a.bottom() + 4));
        }
        QPen pen(coming.colour, kComingWidth);
        pen.setDashPattern({7 / kComingWidth, 5 / kComingWidth});
        pen.setCapStyle(Qt::FlatCap);
        painter.setPen(pen);
        painter.setBrush(Qt::NoBrush);
        painter.drawPolyline(line);
        const auto box = wordsBox(coming);
        auto ground = colours().base;
        ground.setAlpha(225);
        painter.fillRect(box, ground);
        painter.setFont(comingFont());
        painter.setPen(colours().text);
        painter.drawText(box, Qt::AlignCenter, coming.text);
    }
    painter.setFont(plane_.font());
}

}  // namespace tacto::gui
