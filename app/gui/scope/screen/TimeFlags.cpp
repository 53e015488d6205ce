#include "app/gui/scope/screen/TimeFlags.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kFlagWidth = 136;
constexpr double kFlagPadding = 8;
constexpr double kArrow = 6;
constexpr double kBesideTheBox = 4;  // pixels; traces this close to the side of the box are not hidden by it

/// Returns how much of `drawn` the box `whole` would hide, in square pixels.
double hiddenBy(const QRectF& whole, const std::vector<QRectF>& drawn) {
    const auto box = whole.adjusted(kBesideTheBox, 0, -kBesideTheBox, 0);
    double area = 0;
    for (const auto& its : drawn) {
        const auto shared = its.intersected(box);
        if (!shared.isEmpty()) area += shared.width() * shared.height();
    }
    return area;
}

/// Moves `box` up or down within `within` to where it hides least of `drawn`. Prefers places near the present one,
/// because a box that jumps cannot be read.
QRectF atClearHeight(const QRectF& box, const QRectF& within, const std::vector<QRectF>& drawn) {
    constexpr double kStep = 8;           // pixels
    constexpr double kClearlyLess = 0.8;  // share of what is hidden now: noise must not move the box
    std::vector<QRectF> below;
    std::copy_if(drawn.begin(), drawn.end(), std::back_inserter(below),
                 [&](const QRectF& its) { return its.right() > box.left() && its.left() < box.right(); });
    QRectF best = box;
    double least = hiddenBy(box, below);
    const double farthest = within.height();
    for (double away = kStep; least > 0 && away < farthest; away += kStep) {
        for (const double top : {box.top() - away, box.top() + away}) {
            if (top < within.top() || top + box.height() > within.bottom()) continue;
            QRectF moved = box;
            moved.moveTop(top);
            const double its = hiddenBy(moved, below);
            if (!(its < kClearlyLess * least)) continue;
            least = its;
            best = moved;
        }
    }
    return best;
}

/// Moves two boxes that overlap apart within `room`: one below the other, or beside it where many rows need the height.
void moveApart(QRectF& one, QRectF& other, const QRectF& room) {
    if (!one.intersects(other)) return;
    if (one.height() + kFlagPadding + other.height() <= room.height()) {
        one.moveTop(std::clamp(one.top(), room.top(), room.bottom() - other.height() - kFlagPadding - one.height()));
        other.moveTop(one.bottom() + kFlagPadding);
        return;
    }
    auto& left = one.center().x() <= other.center().x() ? one : other;
    auto& right = &left == &one ? other : one;
    const double last = room.right() - left.width() - kFlagPadding - right.width();
    left.moveLeft(std::max(room.left(), std::min(left.left(), last)));
    right.moveLeft(left.right() + kFlagPadding);
}

}  // namespace

QSizeF TimeFlags::sizeOf(const OverlayState::Flag& flag) const {
    const QFontMetricsF metrics(plane_.font()), strong(textFont(TextSize::Small, QFont::DemiBold));
    const double between = metrics.height();
    double width = strong.horizontalAdvance(flag.name) + between + strong.horizontalAdvance(flag.position);
    for (const auto& row : flag.rows) {
        width = std::max(width, strong.horizontalAdvance(row.letter) + between + metrics.horizontalAdvance(row.text));
    }
    const double line = metrics.height();
    const double rows = flag.rows.empty() ? 0 : static_cast<double>(flag.rows.size()) * line + kFlagPadding;
    return {std::max<double>(width + 2 * kFlagPadding, scaledPx(kFlagWidth)), line + kFlagPadding / 2 + rows};
}

double TimeFlags::belowTheMark() const { return plane_.area().top() + QFontMetricsF(plane_.font()).height() * 1.6; }

std::vector<QRectF> TimeFlags::boxes() const {
    std::vector<QRectF> boxes;
    if (state_.flags.size() != 2) return boxes;
    const auto a = plane_.area();
    const bool ordered = state_.timeCursors_s[0] <= state_.timeCursors_s[1];
    const double top = belowTheMark();
    const QRectF room(a.left(), top, a.width(), a.bottom() - top);
    auto drawn = drawnBoxes();
    for (std::size_t i = 0; i < 2; ++i) {
        const auto size = sizeOf(state_.flags[i]);
        const double at = plane_.x(state_.timeCursors_s[i]);
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
    moveApart(boxes[0], boxes[1], room);
    return boxes;
}

std::vector<QRectF> TimeFlags::drawnBoxes() const {
    constexpr double kBeside = 3;  // pixels; a line that touches the box is hidden too
    std::vector<QRectF> boxes;
    boxes.reserve(state_.drawn.size() + 1);
    for (const auto& its : state_.drawn) {
        boxes.push_back(QRectF(QPointF(plane_.x(its.from_s), plane_.y(its.high) - kBeside),
                               QPointF(plane_.x(its.to_s), plane_.y(its.low) + kBeside)) &
                        plane_.area());
    }
    return boxes;
}

QRectF TimeFlags::spanBox(const std::vector<QRectF>& flags) const {
    auto drawn = drawnBoxes();
    drawn.insert(drawn.end(), flags.begin(), flags.end());
    const auto a = plane_.area();
    const auto within = [&](double key_s) { return std::clamp(plane_.x(key_s), a.left(), a.right()); };
    const double middle = (within(state_.timeCursors_s[0]) + within(state_.timeCursors_s[1])) / 2;
    const auto box = plane_.tagBox(QPointF(middle, std::round(a.center().y())), state_.timeSpan);
    return atClearHeight(box, a, drawn);
}

void TimeFlags::drawFlag(QCPPainter& painter, const QRectF& box, const OverlayState::Flag& flag, bool focused) const {
    const auto& c = colours();
    const double line = QFontMetricsF(plane_.font()).height();
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
        painter.setFont(plane_.font());
        painter.setPen(c.text);
        painter.drawText(inside(row), Qt::AlignRight | Qt::AlignVCenter, its.text);
        row.translate(0, line);
    }
    painter.setFont(plane_.font());
}

void TimeFlags::draw(QCPPainter& painter) const {
    if (state_.timeCursors_s.size() != 2) return;
    const auto& c = colours();
    const auto a = plane_.area();
    for (int i = 0; i < 2; ++i) {
        const double at = plane_.x(state_.timeCursors_s[static_cast<std::size_t>(i)]);
        if (at < a.left() || at > a.right()) continue;
        // Not through the letter of the trigger's mark.
        const bool marked = state_.trigger && state_.trigger->moment_s &&
                            plane_.pennant(Qt::TopEdge, plane_.x(*state_.trigger->moment_s), "T")
                                .box.contains(QPointF(at, a.top() + 1));
        plane_.drawLine(painter, QLineF(at, marked ? belowTheMark() : a.top(), at, a.bottom()),
                        state_.focusedCursor == i ? c.text : c.quiet, Qt::DashLine);
    }
    const auto [first, last] = std::minmax(state_.timeCursors_s[0], state_.timeCursors_s[1]);
    const double from = std::clamp(plane_.x(first), a.left(), a.right());
    const double to = std::clamp(plane_.x(last), a.left(), a.right());
    const auto placed = boxes();
    const auto span = spanBox(placed);
    const double half = std::round(span.center().y());
    plane_.drawLine(painter, QLineF(from, half, to, half), c.text, Qt::SolidLine);
    for (const auto& [end, inwards] : {std::pair(from, kArrow), std::pair(to, -kArrow)}) {
        plane_.drawLine(painter, QLineF(end, half, end + inwards, half - kArrow / 2), c.text, Qt::SolidLine);
        plane_.drawLine(painter, QLineF(end, half, end + inwards, half + kArrow / 2), c.text, Qt::SolidLine);
    }
    plane_.drawTag(painter, span.center(), state_.timeSpan, c.text);
    for (std::size_t i = 0; i < placed.size(); ++i) {
        drawFlag(painter, placed[i], state_.flags[i], state_.focusedCursor == static_cast<int>(i));
    }
}

}  // namespace tacto::gui
