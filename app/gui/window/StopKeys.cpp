#include "app/gui/window/StopKeys.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>
#include <QWindow>
#include <Qsci/qsciscintilla.h>
#include <utility>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/KeyState.h"

namespace tacto::gui {

namespace {

constexpr int kFirstEvery_ms = 50;
constexpr quint32 kBreak = 0xFF6B;  // X's symbol for Ctrl+Pause, for which Qt has no key

bool takesText(const QWidget* widget) {
    if (const auto* line = qobject_cast<const QLineEdit*>(widget)) return !line->isReadOnly();
    if (const auto* text = qobject_cast<const QTextEdit*>(widget)) return !text->isReadOnly();
    if (const auto* text = qobject_cast<const QPlainTextEdit*>(widget)) return !text->isReadOnly();
    if (const auto* code = qobject_cast<const QsciScintilla*>(widget)) return !code->isReadOnly();
    if (const auto* combo = qobject_cast<const QComboBox*>(widget)) return combo->isEditable();
    return qobject_cast<const QAbstractSpinBox*>(widget) != nullptr;
}

bool isReturn(const QKeyEvent& key) { return key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter; }

}  // namespace

StopKeys::StopKeys(std::function<void(const char*)> stop, QObject* parent) : QObject(parent), stop_(std::move(stop)) {
    // Installing the filter again puts it before all others.
    connect(&first_, &QTimer::timeout, this, [this] { qApp->installEventFilter(this); });
    first_.setInterval(kFirstEvery_ms);
    stayFirst(true);
    returnReleased_.setSingleShot(true);
    connect(&returnReleased_, &QTimer::timeout, this, [this] {
        returnHeld_ = isKeyDown(returnCode_).value_or(false);
        if (returnHeld_) returnReleased_.start(kReleased_ms);
    });
}

void StopKeys::stayFirst(bool stays) {
    if (stays == first_.isActive()) return;
    qApp->installEventFilter(this);
    stays ? first_.start() : first_.stop();
}

StopKeys::~StopKeys() { qApp->removeEventFilter(this); }

bool StopKeys::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Show && watched->isWidgetType()) {
        auto* widget = static_cast<QWidget*>(watched);
        if (widget->isWindow() && widget->isModal()) widget->setWindowModality(Qt::NonModal);
    }
    if (event->type() == QEvent::KeyRelease && isReturn(*static_cast<QKeyEvent*>(event)))
        returnReleased_.start(kReleased_ms);
    if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride) return false;
    return pressed(watched, *static_cast<QKeyEvent*>(event));
}

/// The first press of Return presses the focused button. The repeats of a held key press no button and enter no line,
/// wherever the focus is by then.
bool StopKeys::returnPressed(QObject* watched, const QKeyEvent& key) {
    returnCode_ = key.nativeScanCode();
    returnReleased_.start(isKeyDown(returnCode_) ? kReleased_ms : kSilent_ms);
    auto* button = qobject_cast<QAbstractButton*>(watched);
    if (std::exchange(returnHeld_, true) || key.isAutoRepeat())
        return button != nullptr || qobject_cast<const QLineEdit*>(watched) != nullptr;
    if (button == nullptr || !button->isEnabled()) return false;
    const auto* confirm = qobject_cast<const ConfirmButton*>(button);
    if (confirm == nullptr || confirm->listens(timeOf(key))) button->click();
    return true;
}

/// True if the key went to a window of the participant.
bool StopKeys::isParticipants(const QObject* watched) {
    const auto* widget = qobject_cast<const QWidget*>(watched);
    const QObject* window = widget == nullptr ? watched : widget->window();
    return window->property("stopsAs").toString() == "participant";
}

/// Returns true if no other widget may see the key. Called for the window, then for the widget: stopping twice is
/// harmless.
bool StopKeys::pressed(QObject* watched, const QKeyEvent& key) {
    const auto* focus = QApplication::focusWidget();
    const bool theirs = isParticipants(watched);
    // Each press is one stop by the participant, and the third ends the session; so repeats must not count.
    const bool held = key.isAutoRepeat();
    if (theirs && held) return false;
    switch (key.nativeVirtualKey() == kBreak ? Qt::Key_Pause : key.key()) {
        case Qt::Key_Escape:
            stop_(theirs ? "participant (Esc)" : held ? "operator (Esc, held)" : "operator (Esc)");
            return false;  // Esc must also close dialogs and popups
        case Qt::Key_Pause:
            stop_(theirs ? "participant (Pause)" : held ? "operator (Pause, held)" : "operator (Pause)");
            return true;
        case Qt::Key_Space:
            if (takesText(focus) || (watched->isWidgetType() && takesText(static_cast<QWidget*>(watched))))
                return false;
            stop_(theirs ? "participant (Space)" : held ? "operator (Space, held)" : "operator (Space)");
            return key.type() == QEvent::KeyPress;
        case Qt::Key_Return:
        case Qt::Key_Enter:
            return key.type() == QEvent::KeyPress && watched->isWidgetType() && returnPressed(watched, key);
        case Qt::Key_F5:
            if (key.modifiers() != Qt::ShiftModifier) return false;
            stop_("operator (Shift+F5)");
            return true;
        default:
            return false;
    }
}

}  // namespace tacto::gui

#include "moc_StopKeys.cpp"
