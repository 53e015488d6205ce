#include "app/gui/window/TourFrame.h"

#include <QPainter>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kLine = 3;  // px at the designed size of text
constexpr int kHalo = 1;  // on either side of it, so that it stands out on any ground

}  // namespace

QRect visiblePart(const TourTarget& target) {
    auto* widget = target.widget;
    if (widget == nullptr || !widget->isVisible()) return {};
    auto seen = widget->rect();
    if (!target.part.isNull()) seen &= target.part;
    // What its ancestors cut off. Not visibleRegion(): what lies over it, as the frame does, would be taken off.
    for (auto* inside = widget; !inside->isWindow() && inside->parentWidget() != nullptr;) {
        seen.translate(inside->pos());
        inside = inside->parentWidget();
        seen &= inside->rect();
    }
    return seen;
}

TourFrame::TourFrame(QWidget* window) : QWidget(window) {
    setObjectName("tourFrame");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
}

void TourFrame::follow(const TourTarget& target) {
    const auto seen = visiblePart(target);
    if (seen.isEmpty()) return hide();
    // A dialog is a window of its own: the frame goes there. Deleted with it, it is made anew by the tour.
    auto* window = target.widget->window();
    if (parentWidget() != window) setParent(window);
    const int line = scaledPx(kLine) + 2 * kHalo;
    const auto around = seen.adjusted(-line, -line, line, line) & window->rect();
    if (geometry() != around) setGeometry(around);
    if (!isVisible()) show();
    raise();
}

void TourFrame::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto& c = colours();
    const double line = scaledPx(kLine);
    const double inset = kHalo + line / 2;
    const auto frame = QRectF(rect()).adjusted(inset, inset, -inset, -inset);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(c.base, line + 2 * kHalo));
    painter.drawRect(frame);
    painter.setPen(QPen(c.text, line));
    painter.drawRect(frame);
}

}  // namespace tacto::gui

#include "moc_TourFrame.cpp"
