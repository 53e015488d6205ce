#include "app/gui/scope/ScopeOverlay.h"

#include <algorithm>
#include <cmath>

#include "app/gui/scope/ClearPlace.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kReach = 5;  ///< pixels beside a line within which it is taken hold of
constexpr int kFlagWidth = 136;
constexpr double kFlagPadding = 8;
constexpr double kArrow = 6;
constexpr int kWordChars = 24;

}  // namespace

ScopeOverlay::ScopeOverlay(QCPAxis* keyAxis, QCPAxis* valueAxis)
    : QCPLayerable(keyAxis->parentPlot(), "overlay"), keys_(keyAxis), values_(valueAxis) {}

void ScopeOverlay::applyDefaultAntialiasingHint(QCPPainter* painter) const { painter->setAntialiasing(false); }

QRect ScopeOverlay::clipRect() const { return area().adjusted(-1, -1, 2, 2).toRect(); }

QFont ScopeOverlay::font() const { return textFont(TextSize::Small); }

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

ScopeOverlay::Pennant ScopeOverlay::levelTag(int cursor) const {
    const auto i = static_cast<std::size_t>(cursor);
    return pennant(Qt::RightEdge, y(state.levelCursors[i]), state.levelTexts[i]);
}

QSizeF ScopeOverlay::sizeOf(const OverlayState::Flag& flag) const {
    const QFontMetricsF metrics(font()), strong(textFont(TextSize::Small, QFont::DemiBold));
    const double between = metrics.height();
    double width = strong.horizontalAdvance(flag.name) + between + strong.horizontalAdvance(flag.position);
    for (const auto& row : flag.rows) {
        width = std::max(width, strong.horizontalAdvance(row.letter) + between + metrics.horizontalAdvance(row.text));
    }
    const double line = metrics.height();
    const double rows = flag.rows.empty() ? 0 : static_cast<double>(flag.rows.size()) * line + kFlagPadding;
    return {std::max<double>(width + 2 * kFlagPadding, scaledPx(kFlagWidth)), line + kFlagPadding / 2 + rows};
}

std::vector<QRectF> ScopeOverlay::flagBoxes() const {
    std::vector<QRectF> boxes;
    if (state.flags.size() != 2) return boxes;
    const auto a = area();
    const bool ordered = state.timeCursors_s[0] <= state.timeCursors_s[1];
    const double top = a.top() + QFontMetricsF(font()).height() * 1.6;  // below the trigger's mark
    const QRectF room(a.left(), top, a.width(), a.bottom() - top);
    auto drawn = drawnBoxes();
    drawn.push_back(spanBox(drawn));
    for (std::size_t i = 0; i < 2; ++i) {
        const auto size = sizeOf(state.flags[i]);
        const double at = x(state.timeCursors_s[i]);
        const auto beside = [&](bool left) {
            const double from = std::clamp(left ? at - size.width() : at, a.left(), a.right() - size.width());
            return atClearHeight(QRectF(QPointF(from, top), size), room, drawn);
        };
        bool left = ordered == (i == 0);
        const bool fitsLeft = at - size.width() >= a.left(), fitsRight = at + size.width() <= a.right();
        if (fitsLeft != fitsRight) left = fitsLeft;
        auto box = beside(left);
        if (const auto other = beside(!left);
            fitsLeft && fitsRight && hiddenBy(other, drawn) < hiddenBy(box, drawn) / 2)
            box = other;
        boxes.push_back(box);
        drawn.push_back(boxes.back());
    }
    if (boxes[0].intersects(boxes[1])) boxes[1].moveTop(boxes[0].bottom() + kFlagPadding);
    return boxes;
}

std::vector<QRectF> ScopeOverlay::drawnBoxes() const {
    constexpr double kBeside = 3;  // pixels: a line that is touched is hidden
    std::vector<QRectF> boxes;
    boxes.reserve(state.drawn.size() + 1);
    for (const auto& its : state.drawn) {
        boxes.push_back(
            QRectF(QPointF(x(its.from_s), y(its.high) - kBeside), QPointF(x(its.to_s), y(its.low) + kBeside)) & area());
    }
    return boxes;
}

QRectF ScopeOverlay::spanBox(const std::vector<QRectF>& drawn) const {
    const auto a = area();
    const auto within = [&](double key_s) { return std::clamp(x(key_s), a.left(), a.right()); };
    const double middle = (within(state.timeCursors_s[0]) + within(state.timeCursors_s[1])) / 2;
    const auto box = tagBox(QPointF(middle, std::round(a.center().y())), state.timeSpan);
    return atClearHeight(box, a.adjusted(0, a.height() / 4, 0, -a.height() / 4), drawn);
}

GripAt ScopeOverlay::at(const QPointF& pixel) const {
    const auto a = area();
    if (!a.adjusted(-1, -1, 1, 1).contains(pixel)) return {};
    const auto within = [&](const Pennant& p) { return p.shape.boundingRect().adjusted(-2, -2, 2, 2).contains(pixel); };
    // Marks first, then lines: what is drawn last is found first.
    const auto flags = flagBoxes();
    for (int c = static_cast<int>(flags.size()) - 1; c >= 0; --c) {
        if (flags[static_cast<std::size_t>(c)].contains(pixel)) return {Grip::TimeCursor, c};
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
    drawMoments(*painter);
    drawTrigger(*painter);
    for (int lane = 0; lane < static_cast<int>(state.lanes.size()); ++lane) {
        const auto& its = state.lanes[static_cast<std::size_t>(lane)];
        drawPennant(*painter, lanePennant(lane), its.letter, its.colour, its.active);
    }
    drawTimeCursors(*painter);
    drawLevelCursors(*painter);
    drawHover(*painter);
    drawNotes(*painter);
    drawAlarm(*painter);
    if (!state.box) return;
    auto fill = colours().frame;
    fill.setAlpha(40);
    painter->setPen(QPen(colours().frame, 1));
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
            drawLine(painter, QLineF(at, a.top(), at, a.bottom()), colours().zero, Qt::DotLine);
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

void ScopeOverlay::drawFlag(QCPPainter& painter, const QRectF& box, const OverlayState::Flag& flag,
                            bool focused) const {
    const auto& c = colours();
    const double line = QFontMetricsF(font()).height();
    const QRectF head(box.left(), box.top(), box.width(), line + kFlagPadding / 2);
    painter.setPen(QPen(focused ? c.text : c.quiet, 1));
    painter.setBrush(c.base);
    painter.drawRect(box);
    painter.fillRect(head, focused ? c.text : c.quiet);
    painter.setFont(textFont(TextSize::Small, QFont::DemiBold));
    painter.setPen(c.base);
    const auto inside = [](const QRectF& row) { return row.adjusted(kFlagPadding, 0, -kFlagPadding, 0); };
    painter.drawText(inside(head), Qt::AlignLeft | Qt::AlignVCenter, flag.name);
    painter.drawText(inside(head), Qt::AlignRight | Qt::AlignVCenter, flag.position);
    QRectF row(box.left(), head.bottom() + kFlagPadding / 2, box.width(), line);
    for (const auto& its : flag.rows) {
        painter.setFont(textFont(TextSize::Small, QFont::DemiBold));
        painter.setPen(its.colour);
        painter.drawText(inside(row), Qt::AlignLeft | Qt::AlignVCenter, its.letter);
        painter.setFont(font());
        painter.setPen(c.text);
        painter.drawText(inside(row), Qt::AlignRight | Qt::AlignVCenter, its.text);
        row.translate(0, line);
    }
    painter.setFont(font());
}

void ScopeOverlay::drawTimeCursors(QCPPainter& painter) const {
    if (state.timeCursors_s.size() != 2) return;
    const auto& c = colours();
    const auto a = area();
    for (int i = 0; i < 2; ++i) {
        const double at = x(state.timeCursors_s[static_cast<std::size_t>(i)]);
        if (at < a.left() || at > a.right()) continue;
        drawLine(painter, QLineF(at, a.top(), at, a.bottom()), state.focusedCursor == i ? c.text : c.quiet,
                 Qt::DashLine);
    }
    const double from = std::clamp(x(std::min(state.timeCursors_s[0], state.timeCursors_s[1])), a.left(), a.right());
    const double to = std::clamp(x(std::max(state.timeCursors_s[0], state.timeCursors_s[1])), a.left(), a.right());
    const auto span = spanBox(drawnBoxes());
    const double half = std::round(span.center().y());
    drawLine(painter, QLineF(from, half, to, half), c.text, Qt::SolidLine);
    for (const auto& [end, inwards] : {std::pair(from, kArrow), std::pair(to, -kArrow)}) {
        drawLine(painter, QLineF(end, half, end + inwards, half - kArrow / 2), c.text, Qt::SolidLine);
        drawLine(painter, QLineF(end, half, end + inwards, half + kArrow / 2), c.text, Qt::SolidLine);
    }
    drawTag(painter, span.center(), state.timeSpan, c.text);
    const auto boxes = flagBoxes();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        drawFlag(painter, boxes[i], state.flags[i], state.focusedCursor == static_cast<int>(i));
    }
}

void ScopeOverlay::drawLevelCursors(QCPPainter& painter) const {
    if (state.levelCursors.size() != 2) return;
    const auto& c = colours();
    const auto a = area();
    for (int i = 0; i < 2; ++i) {
        const bool focused = state.focusedCursor == 2 + i;
        const auto which = static_cast<std::size_t>(i);
        const double at = y(state.levelCursors[which]);
        const auto colour = focused ? c.text : c.quiet;
        if (at >= a.top() && at <= a.bottom()) {
            drawLine(painter, QLineF(a.left(), at, a.right(), at), colour, Qt::DashLine);
        }
        drawPennant(painter, levelTag(i), state.levelTexts[which], colour, focused);
    }
    const double top = std::clamp(y(std::max(state.levelCursors[0], state.levelCursors[1])), a.top(), a.bottom());
    const double bottom = std::clamp(y(std::min(state.levelCursors[0], state.levelCursors[1])), a.top(), a.bottom());
    const double at = std::round(a.left() + a.width() * 0.85);
    drawLine(painter, QLineF(at, top, at, bottom), c.text, Qt::SolidLine);
    drawTag(painter, QPointF(at, (top + bottom) / 2), state.levelSpan, c.text);
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

/// As in the live plots: a dashed line, the word at its top on a ground of ink.
void ScopeOverlay::drawMoments(QCPPainter& painter) const {
    const auto a = area();
    const auto& c = colours();
    const QFontMetricsF metrics(font());
    for (const auto& moment : state.moments) {
        const double at = x(moment.at_s);
        drawLine(painter, QLineF(at, a.top(), at, a.bottom()), c.text, Qt::DashLine);
        const auto word = metrics.elidedText(moment.word, Qt::ElideRight, metrics.averageCharWidth() * kWordChars);
        QRectF box(at, a.top(), metrics.horizontalAdvance(word) + 6, metrics.height());
        if (box.right() > a.right()) box.moveRight(at);
        painter.fillRect(box, c.text);
        painter.setPen(c.base);
        painter.drawText(box, Qt::AlignCenter, word);
    }
}

/// In the corner, one below the other: the middle belongs to the signal, the edges to handles.
void ScopeOverlay::drawNotes(QCPPainter& painter) const {
    const QFontMetricsF metrics(font());
    const auto a = area();
    double at = a.top() + metrics.height();
    for (const auto& note : state.notes) {
        const double width = metrics.horizontalAdvance(note) + 12;
        drawTag(painter, QPointF(a.right() - width / 2 - metrics.height() * 2, at), note, colours().text);
        at += metrics.height() * 1.6;
    }
}

/// Ink, as every verdict that is not passed: red is for STOP and faults.
void ScopeOverlay::drawAlarm(QCPPainter& painter) const {
    if (state.alarm.isEmpty()) return;
    const auto& c = colours();
    const auto a = area();
    const auto large = textFont(TextSize::Large, QFont::DemiBold);
    const QFontMetricsF metrics(large);
    QRectF box(0, 0, std::min(metrics.horizontalAdvance(state.alarm) + metrics.height(), a.width()),
               metrics.height() * 1.4);
    box.moveCenter(QPointF(a.center().x(), a.bottom() - metrics.height() * 0.9));
    painter.fillRect(box, c.fail);
    painter.setFont(large);
    painter.setPen(c.failText);
    painter.drawText(box, Qt::AlignCenter, metrics.elidedText(state.alarm, Qt::ElideRight, box.width()));
    painter.setFont(font());
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

QRectF ScopeOverlay::tagBox(const QPointF& centre, const QString& text) const {
    const QFontMetricsF metrics(font());
    const auto a = area();
    QRectF box(0, 0, metrics.horizontalAdvance(text) + 12, metrics.height() + 4);
    box.moveCenter(centre);
    box.moveLeft(std::clamp(box.left(), a.left() + 2, std::max(a.left() + 2, a.right() - box.width() - 2)));
    return box;
}

void ScopeOverlay::drawTag(QCPPainter& painter, const QPointF& centre, const QString& text,
                           const QColor& colour) const {
    const auto box = tagBox(centre, text);
    auto ground = colours().base;
    ground.setAlpha(225);
    painter.setPen(QPen(colours().grid, 1));
    painter.setBrush(ground);
    painter.drawRect(box);
    painter.setPen(colour);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace tacto::gui

#include "moc_ScopeOverlay.cpp"
