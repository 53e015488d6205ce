#include "app/gui/pilot/TheirScreen.h"

#include <QPainter>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kThumbWide = 200, kThumbHigh = 125;
}

TheirScreen::TheirScreen(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("The participant’s screen"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TheirScreen::setShows(Shows shows) {
    if (std::exchange(shows_, shows) != shows) update();
}

QSize TheirScreen::sizeHint() const { return {scaledPx(kThumbWide), scaledPx(kThumbHigh)}; }

void TheirScreen::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto& c = colours();
    painter.setPen(QPen(c.edge, 1));
    painter.setBrush(c.window);
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    const QRectF inside = QRectF(rect()).adjusted(9, 9, -9, -9);
    const double wide = inside.width(), high = inside.height();
    if (shows_ == Shows::Targets) {
        painter.setBrush(c.base);
        const double rows[] = {0.36, 0.36, 0.18};
        double y = inside.top();
        for (const double share : rows) {
            for (int i = 0; i < 2; ++i)
                painter.drawRoundedRect(QRectF(inside.left() + i * wide * 0.33, y, wide * 0.31, high * share), 2, 2);
            y += high * (share + 0.05);
        }
    } else if (shows_ == Shows::Dot) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.text);
        painter.drawEllipse(QPointF(inside.left() + wide * 0.32, inside.center().y()), 4, 4);
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.stop);
    painter.drawRoundedRect(QRectF(inside.left() + wide * 0.68, inside.top(), wide * 0.32, high), 2, 2);
}

}  // namespace tacto::gui

#include "moc_TheirScreen.cpp"
