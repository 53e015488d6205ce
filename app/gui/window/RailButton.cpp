#include "app/gui/window/RailButton.h"

#include <QAction>
#include <QApplication>
#include <QPainter>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kRailWidth = 96;
constexpr int kRailNarrow = 56;  // without the word
constexpr int kRailCell = 64;
constexpr int kRailLow = 640;
constexpr int kRailNarrowCell = 56;
constexpr int kRailLowCell = 44;
constexpr int kAroundIcon = 8;  // at least
constexpr int kRailLeft = 12;
constexpr int kRailIcon = 24;
constexpr int kRailBar = 4;
constexpr double kRailNarrowFrom_pt = 15;  // with text this large the word would take the room of the data

bool isLow(const QWidget& button) { return button.window()->height() < kRailLow; }

/// Icons alone, where text is large or the window is too low for all the cells.
bool isNarrow(const QWidget& button) { return QApplication::font().pointSizeF() > kRailNarrowFrom_pt || isLow(button); }

/// An icon grows with the text, as far as its cell has room.
int railIcon(const QWidget& button) {
    const int most = (isLow(button) ? kRailLowCell : kRailNarrowCell) - 2 * kAroundIcon;
    return isNarrow(button) ? std::min(scaledPx(kRailIcon), most) : scaledPx(kRailIcon);
}

}  // namespace

RailButton::RailButton(QAction* action, QString iconName, QWidget* parent)
    : QToolButton(parent), icon_(std::move(iconName)) {
    setDefaultAction(action);
    setObjectName("workspaceButton");
    setFocusPolicy(Qt::TabFocus);
    setAccessibleName(action->text());
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    onFontChange(*this, [this] { updateGeometry(); });
}

QSize RailButton::sizeHint() const {
    if (isNarrow(*this)) return {kRailNarrow, isLow(*this) ? kRailLowCell : kRailNarrowCell};
    const QFontMetrics words(textFont(TextSize::Small));
    return {std::max(kRailWidth, words.horizontalAdvance("Safety check") + kRailLeft + kRailBar), scaledPx(kRailCell)};
}

void RailButton::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const auto& c = colours();
    if (isChecked()) {
        painter.fillRect(rect(), c.selection);
        painter.fillRect(0, 0, kRailBar, height(), c.primary);
    } else if (underMouse()) {
        painter.fillRect(rect(), c.sunken);
    }
    const int size = railIcon(*this);
    const auto picture = iconPixmap(icon_, isEnabled() ? c.text : c.edge, size, devicePixelRatioF());
    if (isNarrow(*this)) {
        painter.drawPixmap((width() - size) / 2, (height() - size) / 2, picture);
    } else {
        painter.setFont(textFont(TextSize::Small));
        const int word = painter.fontMetrics().height();
        const int top = (height() - size - word) / 2;
        painter.drawPixmap(kRailLeft, top, picture);
        painter.setPen(isEnabled() ? c.text : c.edge);
        painter.drawText(QRect(kRailLeft, top + size, width() - kRailLeft, word), Qt::AlignLeft | Qt::AlignVCenter,
                         defaultAction()->text());
    }
    if (!hasFocus() || !window()->testAttribute(Qt::WA_KeyboardFocusChange)) return;
    painter.setPen(QPen(c.text, 2));
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

}  // namespace tacto::gui

#include "moc_RailButton.cpp"
