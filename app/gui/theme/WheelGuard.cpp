#include "app/gui/theme/WheelGuard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QScrollBar>
#include <QTabBar>
#include <QWheelEvent>
#include <QWindow>

namespace tacto::gui {

void WheelGuard::install() {
    static WheelGuard* guard = nullptr;
    if (guard != nullptr) return;
    guard = new WheelGuard(qApp);
    QObject::connect(guard, &QObject::destroyed, [] { guard = nullptr; });
    qApp->installEventFilter(guard);
}

bool WheelGuard::isSetting(const QWidget& widget) {
    if (qobject_cast<const QScrollBar*>(&widget) != nullptr) return false;
    return qobject_cast<const QAbstractSlider*>(&widget) != nullptr ||
           qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr ||
           qobject_cast<const QComboBox*>(&widget) != nullptr || qobject_cast<const QTabBar*>(&widget) != nullptr;
}

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::Wheel) return false;
    if (watched->isWindowType()) {
        // Before Qt gives the focus to what is under the pointer: it goes by the policy.
        const auto* window = QWidget::find(static_cast<QWindow*>(watched)->winId());
        auto* under =
            window == nullptr ? nullptr : window->childAt(static_cast<QWheelEvent*>(event)->position().toPoint());
        for (; under != nullptr; under = under->parentWidget())
            if (under->focusPolicy() == Qt::WheelFocus) under->setFocusPolicy(Qt::StrongFocus);
        return false;
    }
    if (!watched->isWidgetType()) return false;
    const auto* widget = static_cast<QWidget*>(watched);
    if (!isSetting(*widget) || widget->hasFocus()) return false;
    event->ignore();  // so that the next widget around it gets it
    return true;
}

}  // namespace tacto::gui
