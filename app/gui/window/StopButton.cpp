#include "app/gui/window/StopButton.h"

#include <QApplication>
#include <QGuiApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QScreen>
#include <QWindow>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kStopPadding = 16;
constexpr int kStopWidth = 160;
constexpr int kStopHeight = 72;

QFont wordFont() { return textFont(TextSize::Display, QFont::Bold); }

QFont keysFont() { return textFont(TextSize::Small); }

}  // namespace

StopButton::StopButton(std::function<void()> stop, QWidget* parent)
    : QPushButton(tr("STOP"), parent), stop_(std::move(stop)), hint_(tr("Space · Esc · Pause")) {
    nameWidget(*this, "stopButton", tr("STOP"));
    setAutoDefault(false);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    // Acts on the press: the output does not wait until the finger is lifted.
    connect(this, &QPushButton::pressed, this, [this] { stop_(); });
    qApp->installEventFilter(this);
    onFontChange(*this, [this] { updateGeometry(); });
}

/// Returns where on the screen `event` presses a finger, a pen or a mouse button; nothing for other events.
std::optional<QPoint> StopButton::pressedAt(const QEvent& event) {
    switch (event.type()) {
        case QEvent::MouseButtonPress:
        case QEvent::MouseButtonDblClick:
        case QEvent::TabletPress:
        case QEvent::TouchBegin:
            return static_cast<const QPointerEvent&>(event).points().first().globalPosition().toPoint();
        default:
            return std::nullopt;
    }
}

bool StopButton::eventFilter(QObject* watched, QEvent* event) {
    if (!watched->isWindowType()) return false;
    if (event->type() == QEvent::MouseButtonRelease) return std::exchange(taken_, false);
    const auto at = pressedAt(*event);
    if (!at) return false;
    taken_ = false;
    auto* pressed = QWidget::find(static_cast<QWindow*>(watched)->winId());
    // A participant's window has its own STOP, which must answer even if it lies over this one.
    const bool theirs = pressed != nullptr && pressed->property("stopsAs").toString() == "participant";
    if (!isVisible() || window()->isMinimized() || theirs || !rect().contains(mapFromGlobal(*at))) return false;
    auto* popup = QApplication::activePopupWidget();
    const bool plain = (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick) &&
                       static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton;
    const bool comesHere = pressed == window() && popup == nullptr && QWidget::mouseGrabber() == nullptr &&
                           window()->childAt(window()->mapFromGlobal(*at)) == this;
    if (plain && comesHere) return false;  // the button gets this press and stops
    stop_();
    event->accept();
    taken_ = true;  // also takes the release, because a list would choose an entry on release
    if (popup != nullptr) popup->close();
    return true;
}

void StopButton::setHint(const QString& hint) {
    if (std::exchange(hint_, hint) != hint) update();
}

QSize StopButton::sizeHint() const {
    const QFontMetrics word(wordFont()), small(keysFont());
    const int words = std::max(word.horizontalAdvance(text()), small.horizontalAdvance(hint_)) + 2 * kStopPadding;
    return {std::max(scaledPx(kStopWidth), words), std::max(scaledPx(kStopHeight), word.height() + small.height())};
}

void StopButton::paintEvent(QPaintEvent*) {
    const auto style = stateStyle(InterlockState::Faulted);  // the same red as a fault
    QPainter painter(this);
    painter.fillRect(rect(), isDown() ? style.ground.darker(130) : style.ground);
    painter.setPen(style.ink);
    const QFontMetrics word(wordFont()), small(keysFont());
    const int top = (height() - word.height() - small.height()) / 2 - 1;  // keeps the text off the frame
    painter.setFont(wordFont());
    painter.drawText(QRect(0, top, width(), word.height()), Qt::AlignCenter, text());
    painter.setFont(keysFont());
    painter.drawText(QRect(0, top + word.height(), width(), small.height()), Qt::AlignCenter, hint_);
    if (!hasFocus() || !window()->testAttribute(Qt::WA_KeyboardFocusChange)) return;
    painter.setPen(QPen(style.ink, 2));
    painter.drawRect(rect().adjusted(2, 2, -3, -3));
}

SmallStop::SmallStop(std::function<void()> stop, const QWidget& beside)
    : QWidget(nullptr, Qt::Tool | Qt::CustomizeWindowHint | Qt::WindowTitleHint | Qt::WindowStaysOnTopHint |
                           Qt::WindowDoesNotAcceptFocus),
      stop_(new StopButton(std::move(stop), this)) {
    setObjectName("smallStop");
    setWindowTitle(tr("Tactoscope"));
    setAttribute(Qt::WA_ShowWithoutActivating);
    setAttribute(Qt::WA_QuitOnClose, false);
    auto* layout = columnIn(*this);
    layout->addWidget(stop_);
    showState(InterlockState::Disconnected);
    const auto screen = beside.screen()->availableGeometry();
    constexpr int kMargin = 32;
    resize(sizeHint());
    move(screen.right() - width() - kMargin, screen.bottom() - height() - kMargin);
}

void SmallStop::showState(InterlockState state) { stop_->setHint(stateStyle(state).word); }

bool SmallStop::staysAbove() { return !QGuiApplication::platformName().startsWith("wayland"); }

}  // namespace tacto::gui

#include "moc_StopButton.cpp"
