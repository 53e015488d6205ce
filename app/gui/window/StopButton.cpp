#include "app/gui/window/StopButton.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QWindow>

#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kStopPadding = 16;
constexpr int kStopWidth = 160;
constexpr int kStopHeight = 72;

QFont wordFont() { return textFont(TextSize::Display, QFont::Bold); }

QFont keysFont() { return textFont(TextSize::Small); }

QString keys() { return StopButton::tr("Space · Esc · Pause"); }

}  // namespace

StopButton::StopButton(std::function<void()> stop, QWidget* parent)
    : QPushButton(tr("STOP"), parent), stop_(std::move(stop)) {
    setObjectName("stopButton");
    setAccessibleName(tr("STOP"));
    setAutoDefault(false);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    // When it goes down: the output does not wait for the finger to come up again.
    connect(this, &QPushButton::pressed, this, [this] { stop_(); });
    qApp->installEventFilter(this);
    onFontChange(*this, [this] { updateGeometry(); });
}

bool StopButton::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::MouseButtonPress && event->type() != QEvent::MouseButtonDblClick) return false;
    if (QApplication::activePopupWidget() == nullptr || !watched->isWindowType() || !isVisible()) return false;
    const auto at = static_cast<QMouseEvent*>(event)->globalPosition().toPoint();
    if (!QRect(mapToGlobal(QPoint(0, 0)), size()).contains(at)) return false;
    // An entry of the popup that lies above the button is meant, not the button.
    const auto* pressed = static_cast<QWindow*>(watched);
    if (pressed != window()->windowHandle() && pressed->geometry().contains(at)) return false;
    stop_();
    return false;  // the popup closes
}

QSize StopButton::sizeHint() const {
    const QFontMetrics word(wordFont()), small(keysFont());
    const int words = std::max(word.horizontalAdvance(text()), small.horizontalAdvance(keys())) + 2 * kStopPadding;
    return {std::max(scaledPx(kStopWidth), words), std::max(scaledPx(kStopHeight), word.height() + small.height())};
}

void StopButton::paintEvent(QPaintEvent*) {
    const auto style = stateStyle(InterlockState::Faulted);  // the one red of the window
    QPainter painter(this);
    painter.fillRect(rect(), isDown() ? style.ground.darker(130) : style.ground);
    painter.setPen(style.ink);
    const QFontMetrics word(wordFont()), small(keysFont());
    const int top = (height() - word.height() - small.height()) / 2 - 1;  // clear of the frame
    painter.setFont(wordFont());
    painter.drawText(QRect(0, top, width(), word.height()), Qt::AlignCenter, text());
    painter.setFont(keysFont());
    painter.drawText(QRect(0, top + word.height(), width(), small.height()), Qt::AlignCenter, keys());
    if (!hasFocus() || !window()->testAttribute(Qt::WA_KeyboardFocusChange)) return;
    painter.setPen(QPen(style.ink, 2));
    painter.drawRect(rect().adjusted(2, 2, -3, -3));
}

}  // namespace tacto::gui

#include "moc_StopButton.cpp"
