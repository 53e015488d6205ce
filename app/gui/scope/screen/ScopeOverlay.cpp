#include "app/gui/scope/screen/ScopeOverlay.h"

#include <algorithm>
#include <cmath>

#include "app/gui/scope/screen/TimeFlags.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kReach = 5;  ///< pixels around a line within which the mouse can grip it
constexpr int kWordChars = 24;
constexpr const char* kLevelWord = "T";
constexpr const char* kOtherWord = "T₂";
constexpr int kBandAlpha = 48;   ///< of 255: traces stay visible through a band
constexpr double kWidthEnd = 8;  ///< pixels above and below the trigger's level
constexpr double kAlarmLines = 1.4;
constexpr int kAlarmGap = 4;  ///< pixels between the alarm and the traces

QFont alarmFont() { return textFont(TextSize::Large, QFont::DemiBold); }

}  // namespace

ScopeOverlay::ScopeOverlay(QCPAxis* keyAxis, QCPAxis* valueAxis)
    : QCPLayerable(keyAxis->parentPlot(), "overlay"), plane_(keyAxis, valueAxis) {}

void ScopeOverlay::applyDefaultAntialiasingHint(QCPPainter* painter) const { painter->setAntialiasing(false); }

QRect ScopeOverlay::clipRect() const {
    return plane_.area().adjusted(-1, state.alarm.isEmpty() ? -1 : -alarmHeight(), 2, 2).toRect();
}

int ScopeOverlay::alarmHeight() { return int(QFontMetricsF(alarmFont()).height() * kAlarmLines) + kAlarmGap; }

Pennant ScopeOverlay::lanePennant(int lane) const {
    const auto& its = state.lanes[static_cast<std::size_t>(lane)];
    return plane_.pennant(its.right ? Qt::RightEdge : Qt::LeftEdge, plane_.y(its.height), its.letter);
}

/// The pennant at the trigger's level. Moves inwards if a lane's handle is at the same place.
Pennant ScopeOverlay::triggerPennant(double height, const QString& text) const {
    auto its = plane_.pennant(Qt::RightEdge, plane_.y(height), text);
    for (int lane = 0; lane < static_cast<int>(state.lanes.size()); ++lane) {
        if (!state.lanes[static_cast<std::size_t>(lane)].right) continue;
        const auto other = lanePennant(lane).shape.boundingRect();
        if (!other.intersects(its.shape.boundingRect())) continue;
        const double inwards = other.left() - 2 - its.box.right();
        its.box.translate(inwards, 0);
        its.shape.translate(inwards, 0);
    }
    return its;
}

Pennant ScopeOverlay::levelTag(int cursor) const {
    const auto i = static_cast<std::size_t>(cursor);
    // On the side opposite the handle of the active lane.
    const bool left = std::any_of(state.lanes.begin(), state.lanes.end(),
                                  [](const OverlayState::Lane& lane) { return lane.active && lane.right; });
    return plane_.pennant(left ? Qt::LeftEdge : Qt::RightEdge, plane_.y(state.levelCursors[i]), state.levelTexts[i]);
}

GripAt ScopeOverlay::at(const QPointF& pixel) const {
    const auto a = plane_.area();
    if (!a.adjusted(-1, -1, 1, 1).contains(pixel)) return {};
    const auto within = [&](const Pennant& p) { return p.shape.boundingRect().adjusted(-2, -2, 2, 2).contains(pixel); };
    // Searches marks before lines, and what was drawn last first.
    const auto flags = TimeFlags(plane_, state).boxes();
    for (int c = static_cast<int>(flags.size()) - 1; c >= 0; --c) {
        if (flags[static_cast<std::size_t>(c)].contains(pixel)) return {Grip::TimeCursor, c};
    }
    for (int c = static_cast<int>(state.levelCursors.size()) - 1; c >= 0; --c) {
        if (within(levelTag(c))) return {Grip::LevelCursor, c};
    }
    if (state.trigger) {
        const auto& t = *state.trigger;
        if (t.height && within(triggerPennant(*t.height, kLevelWord))) return {Grip::TriggerLevel, 0};
        if (t.other && within(triggerPennant(*t.other, kOtherWord))) return {Grip::TriggerLevel, 1};
        if (t.moment_s && within(plane_.pennant(Qt::TopEdge, plane_.x(*t.moment_s), "T")))
            return {Grip::TriggerMoment, 0};
    }
    for (int lane = static_cast<int>(state.lanes.size()) - 1; lane >= 0; --lane) {
        if (within(lanePennant(lane))) return {Grip::Lane, lane};
    }
    for (int c = 0; c < static_cast<int>(state.timeCursors_s.size()); ++c) {
        if (std::abs(plane_.x(state.timeCursors_s[static_cast<std::size_t>(c)]) - pixel.x()) <= kReach) {
            return {Grip::TimeCursor, c};
        }
    }
    for (int c = 0; c < static_cast<int>(state.levelCursors.size()); ++c) {
        if (std::abs(plane_.y(state.levelCursors[static_cast<std::size_t>(c)]) - pixel.y()) <= kReach) {
            return {Grip::LevelCursor, c};
        }
    }
    return {};
}

void ScopeOverlay::draw(QCPPainter* painter) {
    if (plane_.area().isEmpty()) return;  // the plane is not laid out yet
    painter->setFont(plane_.font());
    drawMarks(*painter);
    drawMoments(*painter);
    drawTrigger(*painter);
    drawComing(*painter);
    for (int lane = 0; lane < static_cast<int>(state.lanes.size()); ++lane) {
        const auto& its = state.lanes[static_cast<std::size_t>(lane)];
        plane_.drawPennant(*painter, lanePennant(lane), its.letter, its.colour, its.active);
    }
    drawLevelCursors(*painter);
    TimeFlags(plane_, state).draw(*painter);
    drawHover(*painter);
    drawNotes(*painter);
    drawAlarm(*painter);
    if (!state.box) return;
    auto fill = colours().frame;
    fill.setAlpha(40);
    painter->setPen(QPen(colours().frame, 1));
    painter->setBrush(fill);
    painter->drawRect(state.box->intersected(plane_.area()));
}

void ScopeOverlay::drawTrigger(QCPPainter& painter) const {
    if (!state.trigger) return;
    const auto& t = *state.trigger;
    const auto a = plane_.area();
    if (t.moment_s) {
        const double at = plane_.x(*t.moment_s);
        if (at >= a.left() && at <= a.right()) {
            plane_.drawLine(painter, QLineF(at, a.top(), at, a.bottom()), colours().zero, Qt::DotLine);
        }
        plane_.drawPennant(painter, plane_.pennant(Qt::TopEdge, at, "T"), "T", t.colour, true);
    }
    auto shade = t.colour;
    shade.setAlpha(kBandAlpha);
    for (const auto& [low, high] : t.hysteresis) {
        const QRectF band(QPointF(a.left(), plane_.y(high)), QPointF(a.right(), plane_.y(low)));
        painter.fillRect(band.intersected(a), shade);
    }
    if (t.other) {
        const double at = plane_.y(*t.other);
        if (at >= a.top() && at <= a.bottom())
            plane_.drawLine(painter, QLineF(a.left(), at, a.right(), at), t.colour, Qt::DotLine);
        plane_.drawPennant(painter, triggerPennant(*t.other, kOtherWord), kOtherWord, t.colour, true);
    }
    if (t.height)
        for (const auto& began : t.began_s) drawWidthWindow(painter, began);
    if (t.height) {
        const double at = plane_.y(*t.height);
        if (at >= a.top() && at <= a.bottom()) {
            plane_.drawLine(painter, QLineF(a.left(), at, a.right(), at), t.colour, Qt::DotLine);
        }
        plane_.drawPennant(painter, triggerPennant(*t.height, kLevelWord), kLevelWord, t.colour, !t.held);
    }
    if (!t.text.isEmpty())
        plane_.drawTag(painter, QPointF(a.center().x(), a.top() + a.height() * 0.12), t.text, t.colour);
}

/// Draws at the trigger's level where a pulse that triggers began: a bar between two ends.
void ScopeOverlay::drawWidthWindow(QCPPainter& painter, const std::pair<double, double>& began_s) const {
    const auto& t = *state.trigger;
    const auto a = plane_.area();
    const double at = plane_.y(*t.height);
    if (at < a.top() || at > a.bottom()) return;
    const double from = plane_.x(began_s.first), to = plane_.x(began_s.second);
    if (to < a.left() || from > a.right()) return;
    const double left = std::max(from, a.left()), right = std::min(to, a.right());
    auto shade = t.colour;
    shade.setAlpha(kBandAlpha);
    painter.fillRect(QRectF(left, at - kWidthEnd, std::max(1.0, right - left), 2 * kWidthEnd), shade);
    for (const double end : {from, to}) {
        if (end >= a.left() && end <= a.right())
            plane_.drawLine(painter, QLineF(end, at - kWidthEnd, end, at + kWidthEnd), t.colour, Qt::SolidLine);
    }
}

void ScopeOverlay::drawLevelCursors(QCPPainter& painter) const {
    if (state.levelCursors.size() != 2) return;
    const auto& c = colours();
    const auto a = plane_.area();
    for (int i = 0; i < 2; ++i) {
        const bool focused = state.focusedCursor == 2 + i;
        const auto which = static_cast<std::size_t>(i);
        const double at = plane_.y(state.levelCursors[which]);
        const auto colour = focused ? c.text : c.quiet;
        if (at >= a.top() && at <= a.bottom()) {
            plane_.drawLine(painter, QLineF(a.left(), at, a.right(), at), colour, Qt::DashLine);
        }
        plane_.drawPennant(painter, levelTag(i), state.levelTexts[which], colour, focused);
    }
    const auto [lower, higher] = std::minmax(state.levelCursors[0], state.levelCursors[1]);
    const double top = std::clamp(plane_.y(higher), a.top(), a.bottom());
    const double bottom = std::clamp(plane_.y(lower), a.top(), a.bottom());
    const double at = std::round(a.left() + a.width() * 0.85);
    plane_.drawLine(painter, QLineF(at, top, at, bottom), c.text, Qt::SolidLine);
    plane_.drawTag(painter, QPointF(at, (top + bottom) / 2), state.levelSpan, c.text);
}

void ScopeOverlay::drawMarks(QCPPainter& painter) const {
    const auto a = plane_.area();
    const QFontMetricsF metrics(plane_.font());
    const double line = metrics.height();
    const double top = a.top() + line * 1.6;
    double written = -1e9;  // where the last word ends: a word that would overlap it is left out
    double marked = -1e9;
    for (const auto& mark : state.marks) {
        const double from = std::max(plane_.x(mark.from_s), a.left());
        const double to = std::min(std::max(plane_.x(mark.to_s), plane_.x(mark.from_s) + 2), a.right());
        if (to < a.left() || from > a.right() || to <= marked + 1) continue;
        marked = to;
        painter.fillRect(QRectF(from, top, std::max(2.0, to - from), 3), colours().amber);
        const double width = metrics.horizontalAdvance(mark.why) + 8;
        double left = std::clamp((from + to - width) / 2, a.left(), std::max(a.left(), a.right() - width));
        if (left < written) continue;
        written = left + width + 4;
        painter.fillRect(QRectF(left, top + 4, width, line), ScopePlane::ground());
        painter.setPen(colours().text);
        painter.setBrush(Qt::NoBrush);
        painter.drawText(QRectF(left, top + 4, width, line), Qt::AlignCenter, mark.why);
    }
}

/// Draws the marks as in the live plots: a dashed line, with its word at the top on a dark background.
void ScopeOverlay::drawMoments(QCPPainter& painter) const {
    const auto a = plane_.area();
    const auto& c = colours();
    const QFontMetricsF metrics(plane_.font());
    for (const auto& moment : state.moments) {
        const double at = plane_.x(moment.at_s);
        plane_.drawLine(painter, QLineF(at, a.top(), at, a.bottom()), c.text, Qt::DashLine);
        const auto word = metrics.elidedText(moment.word, Qt::ElideRight, metrics.averageCharWidth() * kWordChars);
        QRectF box(at, a.top(), metrics.horizontalAdvance(word) + 6, metrics.height());
        if (box.right() > a.right()) box.moveRight(at);
        painter.fillRect(box, c.text);
        painter.setPen(c.base);
        painter.drawText(box, Qt::AlignCenter, word);
    }
}

/// The notes stand in a corner, one below the other: the signal needs the middle, and the handles need the edges.
void ScopeOverlay::drawNotes(QCPPainter& painter) const {
    const QFontMetricsF metrics(plane_.font());
    const auto a = plane_.area();
    double at = a.top() + metrics.height();
    for (const auto& note : state.notes) {
        const double width = metrics.horizontalAdvance(note) + 12;
        plane_.drawTag(painter, QPointF(a.right() - width / 2 - metrics.height() * 2, at), note, colours().text);
        at += metrics.height() * 1.6;
    }
}

/// Uses the ink colour, like every verdict that is not a pass: red is for STOP and faults. Stands above the traces, in
/// the room that the screen keeps for it.
void ScopeOverlay::drawAlarm(QCPPainter& painter) const {
    if (state.alarm.isEmpty()) return;
    const auto& c = colours();
    const auto a = plane_.area();
    const auto large = alarmFont();
    const QFontMetricsF metrics(large);
    QRectF box(0, 0, std::min(metrics.horizontalAdvance(state.alarm) + metrics.height(), a.width()),
               metrics.height() * kAlarmLines);
    box.moveCenter(a.center());
    box.moveBottom(a.top() - kAlarmGap);
    painter.fillRect(box, c.fail);
    painter.setFont(large);
    painter.setPen(c.failText);
    painter.drawText(box, Qt::AlignCenter, metrics.elidedText(state.alarm, Qt::ElideRight, box.width()));
    painter.setFont(plane_.font());
}

void ScopeOverlay::drawHover(QCPPainter& painter) const {
    if (!state.hover) return;
    const auto a = plane_.area();
    const auto& h = *state.hover;
    const double from = std::clamp(plane_.x(h.from_s), a.left(), a.right());
    const double to = std::clamp(plane_.x(h.to_s), a.left(), a.right());
    const double at = a.bottom() - QFontMetricsF(plane_.font()).height() * 3.2;
    painter.setPen(QPen(colours().text, 1));
    painter.drawLine(QLineF(from, at, to, at));
    painter.drawLine(QLineF(from, at - 4, from, at + 4));
    painter.drawLine(QLineF(to, at - 4, to, at + 4));
    plane_.drawTag(painter, QPointF((from + to) / 2, at + QFontMetricsF(plane_.font()).height()), h.text,
                   colours().text);
}

namespace {

constexpr double kComingWidth = 2;  // pixels

QFont comingFont() { return textFont(TextSize::Small, QFont::DemiBold); }

/// Returns the place of the coming train's text, inside the plot.
QRectF wordsBox(const OverlayState::Coming& coming, const ScopePlane& plane) {
    const QFontMetricsF metrics(comingFont());
    const auto a = plane.area();
    double top = a.bottom();
    for (const auto& point : coming.line) top = std::min(top, plane.y(point.y()));
    QRectF box(0, 0, metrics.horizontalAdvance(coming.text) + 4, metrics.height());
    box.moveBottomLeft(QPointF(plane.x(0) + kComingWidth, top - kComingWidth));
    box.moveLeft(std::clamp(box.left(), a.left(), std::max(a.left(), a.right() - box.width())));
    box.moveTop(std::clamp(box.top(), a.top(), std::max(a.top(), a.bottom() - box.height())));
    return box;
}

}  // namespace

void ScopeOverlay::drawComing(QCPPainter& painter) const {
    const auto a = plane_.area();
    for (const auto& coming : state.coming) {
        QPolygonF line;
        for (const auto& point : coming.line) {
            // Clamped, because Qt draws no dashes on a line that reaches a million pixels beyond its device.
            line << QPointF(std::clamp(plane_.x(point.x()), a.left() - 4, a.right() + 4),
                            std::clamp(plane_.y(point.y()), a.top() - 4, a.bottom() + 4));
        }
        QPen pen(coming.colour, kComingWidth);
        pen.setDashPattern({7 / kComingWidth, 5 / kComingWidth});
        pen.setCapStyle(Qt::FlatCap);
        painter.setPen(pen);
        painter.setBrush(Qt::NoBrush);
        painter.drawPolyline(line);
        const auto box = wordsBox(coming, plane_);
        painter.fillRect(box, ScopePlane::ground());
        painter.setFont(comingFont());
        painter.setPen(colours().text);
        painter.drawText(box, Qt::AlignCenter, coming.text);
    }
    painter.setFont(plane_.font());
}

}  // namespace tacto::gui

#include "moc_ScopeOverlay.cpp"
