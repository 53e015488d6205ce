#include "app/gui/scope/ScopeOverlay.h"

#include <algorithm>
#include <cmath>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr double kReach = 5;  ///< pixels beside a line within which it is taken hold of

}  // namespace

ScopeOverlay::ScopeOverlay(QCPAxis* keyAxis, QCPAxis* valueAxis)
    : QCPLayerable(keyAxis->parentPlot(), "overlay"), keys_(keyAxis), values_(valueAxis) {}

void ScopeOverlay::applyDefaultAntialiasingHint(QCPPainter* painter) const { painter->setAntialiasing(false); }

QRect ScopeOverlay::clipRect() const { return area().adjusted(-1, -1, 2, 2).toRect(); }

QFont ScopeOverlay::font() const {
    auto small = mParentPlot->font();
    if (small.pointSizeF() > 0) small.setPointSizeF(small.pointSizeF() * 0.85);
    return small;
}

double ScopeOverlay::x(double key_s) const {
    const auto range = keys_->range();
    return area().left() + (key_s - range.lower) / range.size() * area().width();
}

double ScopeOverlay::y(double height) const {
    const auto range = values_->range();
    return area().bottom() - (height - range.lower) / range.size() * area().height();
}

ScopeOverlay::Pennant ScopeOverlay::pennant(Qt::Edge edge, double along, const QString& text) const {
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

ScopeOverlay::Pennant ScopeOverlay::lanePennant(int lane) const {
    const auto& its = state.lanes[static_cast<std::size_t>(lane)];
    return pennant(Qt::LeftEdge, y(its.height), its.letter);
}

ScopeOverlay::Pennant ScopeOverlay::timeTag(int cursor) const {
    return pennant(Qt::BottomEdge, x(state.timeCursors_s[static_cast<std::size_t>(cursor)]),
                   cursor == 0 ? QStringLiteral("X1") : QStringLiteral("X2"));
}

ScopeOverlay::Pennant ScopeOverlay::levelTag(int cursor) const {
    return pennant(Qt::RightEdge, y(state.levelCursors[static_cast<std::size_t>(cursor)]),
                   cursor == 0 ? QStringLiteral("Y1") : QStringLiteral("Y2"));
}

GripAt ScopeOverlay::at(const QPointF& pixel) const {
    const auto a = area();
    if (!a.adjusted(-1, -1, 1, 1).contains(pixel)) return {};
    const auto within = [&](const Pennant& p) { return p.shape.boundingRect().adjusted(-2, -2, 2, 2).contains(pixel); };
    // Marks first, then lines: what is drawn last is found first.
    for (int c = static_cast<int>(state.timeCursors_s.size()) - 1; c >= 0; --c) {
        if (within(timeTag(c))) return {Grip::TimeCursor, c};
    }
    for (int c = static_cast<int>(state.levelCursors.size()) - 1; c >= 0; --c) {
        if (within(levelTag(c))) return {Grip::LevelCursor, c};
    }
    if (state.trigger) {
        const auto& t = *state.trigger;
        if (t.height && within(pennant(Qt::RightEdge, y(*t.height), "T"))) return {Grip::TriggerLevel, 0};
        if (t.moment_s && within(pennant(Qt::TopEdge, x(*t.moment_s), "T"))) return {Grip::TriggerMoment, 0};
    }
    for (int lane = static_cast<int>(state.lanes.size()) - 1; lane >= 0; --lane) {
        if (within(lanePennant(lane))) return {Grip::Lane, lane};
    }
    for (int c = 0; c < static_cast<int>(state.timeCursors_s.size()); ++c) {
        if (std::abs(x(state.timeCursors_s[static_cast<std::size_t>(c)]) - pixel.x()) <= kReach) {
            return {Grip::TimeCursor, c};
        }
    }
    for (int c = 0; c < static_cast<int>(state.levelCursors.size()); ++c) {
        if (std::abs(y(state.levelCursors[static_cast<std::size_t>(c)]) - pixel.y()) <= kReach) {
            return {Grip::LevelCursor, c};
        }
    }
    return {};
}

void ScopeOverlay::draw(QCPPainter* painter) {
    if (area().isEmpty()) return;  // not laid out yet
    painter->setFont(font());
    drawMarks(*painter);
    drawNote(*painter);
    drawTrigger(*painter);
    for (int lane = 0; lane < static_cast<int>(state.lanes.size()); ++lane) {
        const auto& its = state.lanes[static_cast<std::size_t>(lane)];
        drawPennant(*painter, lanePennant(lane), its.letter, its.colour, its.active);
    }
    drawCursors(*painter);
    drawHover(*painter);
    if (!state.box) return;
    auto fill = colours().accent;
    fill.setAlpha(40);
    painter->setPen(QPen(colours().accent, 1));
    painter->setBrush(fill);
    painter->drawRect(state.box->intersected(area()));
}

void ScopeOverlay::drawLine(QCPPainter& painter, const QLineF& line, const QColor& colour, Qt::PenStyle style) const {
    painter.setPen(QPen(colour, 1, style));
    painter.drawLine(line);
}

void ScopeOverlay::drawPennant(QCPPainter& painter, const Pennant& pennant, const QString& text, const QColor& colour,
                               bool filled) const {
    painter.setPen(QPen(colour, 1));
    painter.setBrush(filled ? colour : colours().base);
    painter.setAntialiasing(true);
    painter.drawPolygon(pennant.shape);
    painter.setAntialiasing(false);
    painter.setPen(filled ? colours().base : colour);
    painter.drawText(pennant.box, Qt::AlignCenter, text);
}

void ScopeOverlay::drawTrigger(QCPPainter& painter) const {
    if (!state.trigger) return;
    const auto& t = *state.trigger;
    const auto a = area();
    if (t.moment_s) {
        const double at = x(*t.moment_s);
        if (at >= a.left() && at <= a.right()) {
            drawLine(painter, QLineF(at, a.top(), at, a.bottom()), colours().reference, Qt::DotLine);
        }
        drawPennant(painter, pennant(Qt::TopEdge, at, "T"), "T", t.colour, true);
    }
    if (t.height) {
        const double at = y(*t.height);
        if (at >= a.top() && at <= a.bottom()) {
            drawLine(painter, QLineF(a.left(), at, a.right(), at), t.colour, Qt::DotLine);
        }
        drawPennant(painter, pennant(Qt::RightEdge, at, "T"), "T", t.colour, !t.held);
    }
    if (!t.text.isEmpty()) drawTag(painter, QPointF(a.center().x(), a.top() + a.height() * 0.12), t.text, t.colour);
}

void ScopeOverlay::drawCursors(QCPPainter& painter) const {
    const auto& c = colours();
    const auto a = area();
    for (int i = 0; i < static_cast<int>(state.timeCursors_s.size()); ++i) {
        const bool focused = state.focusedCursor == i;
        const double at = x(state.timeCursors_s[static_cast<std::size_t>(i)]);
        const auto colour = focused ? c.accent : c.quiet;
        if (at >= a.left() && at <= a.right()) {
            drawLine(painter, QLineF(at, a.top(), at, a.bottom()), colour, Qt::DashLine);
        }
        drawPennant(painter, timeTag(i), i == 0 ? "X1" : "X2", colour, focused);
    }
    for (int i = 0; i < static_cast<int>(state.levelCursors.size()); ++i) {
        const bool focused = state.focusedCursor == 2 + i;
        const double at = y(state.levelCursors[static_cast<std::size_t>(i)]);
        const auto colour = focused ? c.accent : c.quiet;
        if (at >= a.top() && at <= a.bottom()) {
            drawLine(painter, QLineF(a.left(), at, a.right(), at), colour, Qt::DashLine);
        }
        drawPennant(painter, levelTag(i), i == 0 ? "Y1" : "Y2", colour, focused);
    }
}

void ScopeOverlay::drawMarks(QCPPainter& painter) const {
    const auto a = area();
    const QFontMetricsF metrics(font());
    const double line = metrics.height();
    const double top = a.top() + line * 1.6;
    double written = -1e9;  // where the last word ends: words that would lie on it are left out
    double marked = -1e9;
    for (const auto& mark : state.marks) {
        const double from = std::max(x(mark.from_s), a.left());
        const double to = std::min(std::max(x(mark.to_s), x(mark.from_s) + 2), a.right());
        if (to < a.left() || from > a.right() || to <= marked + 1) continue;
        marked = to;
        painter.fillRect(QRectF(from, top, std::max(2.0, to - from), 3), colours().amber);
        const double width = metrics.horizontalAdvance(mark.why) + 8;
        double left = std::clamp((from + to - width) / 2, a.left(), std::max(a.left(), a.right() - width));
        if (left < written) continue;
        written = left + width + 4;
        auto ground = colours().base;
        ground.setAlpha(225);
        painter.fillRect(QRectF(left, top + 4, width, line), ground);
        painter.setPen(colours().text);
        painter.setBrush(Qt::NoBrush);
        painter.drawText(QRectF(left, top + 4, width, line), Qt::AlignCenter, mark.why);
    }
}

void ScopeOverlay::drawNote(QCPPainter& painter) const {
    if (state.note.isEmpty()) return;
    const QFontMetricsF metrics(font());
    const auto a = area();
    // In the corner: the middle belongs to the signal, the edges to handles.
    const double width = metrics.horizontalAdvance(state.note) + 12;
    drawTag(painter, QPointF(a.right() - width / 2 - metrics.height() * 2, a.top() + metrics.height()), state.note,
            colours().text);
}

void ScopeOverlay::drawHover(QCPPainter& painter) const {
    if (!state.hover) return;
    const auto a = area();
    const auto& h = *state.hover;
    const double from = std::clamp(x(h.from_s), a.left(), a.right());
    const double to = std::clamp(x(h.to_s), a.left(), a.right());
    const double at = a.bottom() - QFontMetricsF(font()).height() * 3.2;
    painter.setPen(QPen(colours().text, 1));
    painter.drawLine(QLineF(from, at, to, at));
    painter.drawLine(QLineF(from, at - 4, from, at + 4));
    painter.drawLine(QLineF(to, at - 4, to, at + 4));
    drawTag(painter, QPointF((from + to) / 2, at + QFontMetricsF(font()).height()), h.text, colours().text);
}

void ScopeOverlay::drawTag(QCPPainter& painter, const QPointF& centre, const QString& text,
                           const QColor& colour) const {
    const QFontMetricsF metrics(font());
    const auto a = area();
    QRectF box(0, 0, metrics.horizontalAdvance(text) + 12, metrics.height() + 4);
    box.moveCenter(centre);
    box.moveLeft(std::clamp(box.left(), a.left() + 2, std::max(a.left() + 2, a.right() - box.width() - 2)));
    auto ground = colours().base;
    ground.setAlpha(225);
    painter.setPen(QPen(colours().grid, 1));
    painter.setBrush(ground);
    painter.drawRect(box);
    painter.setPen(colour);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace tacto::gui
