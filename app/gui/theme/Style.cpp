#include "app/gui/theme/Style.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QMetaMethod>
#include <QPushButton>
#include <QScrollBar>
#include <QTabBar>
#include <QToolButton>
#include <QWheelEvent>
#include <QWindow>
#include <qcustomplot.h>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kButtonIcon = 16, kBeforeTheWord = 4;
constexpr int kGrid = 8;
}  // namespace

MnemonicStyle::MnemonicStyle() : QProxyStyle("Fusion") { qApp->installEventFilter(this); }

/// Fusion leaves 4 px between an icon and its text; the design has 8. So the icon gets more room, and is drawn square
/// at the left of this room (Icons.cpp).
void MnemonicStyle::polish(QWidget* widget) {
    QProxyStyle::polish(widget);
    const auto* tool = qobject_cast<QToolButton*>(widget);
    const bool beside = tool != nullptr && tool->toolButtonStyle() == Qt::ToolButtonTextBesideIcon;
    if (qobject_cast<QPushButton*>(widget) == nullptr && !beside) return;
    static_cast<QAbstractButton*>(widget)->setIconSize({scaledPx(kButtonIcon + kBeforeTheWord), scaledPx(kButtonIcon)});
}

int MnemonicStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                             QStyleHintReturn* returned) const {
    return hint == SH_UnderlineShortcut ? int(held_) : QProxyStyle::styleHint(hint, option, widget, returned);
}

/// Margins and spacings that a layout does not set are multiples of the grid; small icons grow with the text.
int MnemonicStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
    switch (metric) {
        case PM_LayoutLeftMargin:
        case PM_LayoutTopMargin:
        case PM_LayoutRightMargin:
        case PM_LayoutBottomMargin:
        case PM_LayoutHorizontalSpacing:
            return kGrid;
        case PM_LayoutVerticalSpacing:
            return kGrid / 2;  // rows are already high enough
        case PM_SmallIconSize:
        case PM_LineEditIconSize:
            return scaledPx(kButtonIcon);
        default:
            return QProxyStyle::pixelMetric(metric, option, widget);
    }
}

bool MnemonicStyle::eventFilter(QObject* watched, QEvent* event) {
    const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease;
    if (key && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Alt) underline(event->type() == QEvent::KeyPress);
    // Alt+Tab moves the focus to another program, which then gets the release of Alt.
    if (event->type() == QEvent::ApplicationStateChange) underline(false);
    return QProxyStyle::eventFilter(watched, event);
}

void MnemonicStyle::underline(bool held) {
    if (held == std::exchange(held_, held)) return;
    for (auto* widget : QApplication::allWidgets()) {
        if (widget->isVisible()) widget->update();
    }
}

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

namespace {

/// True if the plot itself, or an object connected to it, uses the wheel.
bool zoomsByWheel(const QCustomPlot& plot) {
    struct Open : QCustomPlot {
        using QCustomPlot::isSignalConnected;
    };
    return plot.interactions().testFlag(QCP::iRangeZoom) ||
           (plot.*&Open::isSignalConnected)(QMetaMethod::fromSignal(&QCustomPlot::mouseWheel));
}

}  // namespace

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::Wheel) return false;
    if (watched->isWindowType()) {
        // Runs before Qt focuses the widget under the pointer, as its focus policy may ask for.
        const auto* window = QWidget::find(static_cast<QWindow*>(watched)->winId());
        auto* under =
            window == nullptr ? nullptr : window->childAt(static_cast<QWheelEvent*>(event)->position().toPoint());
        for (; under != nullptr; under = under->parentWidget())
            if (under->focusPolicy() == Qt::WheelFocus) under->setFocusPolicy(Qt::StrongFocus);
        return false;
    }
    if (!watched->isWidgetType()) return false;
    auto* widget = static_cast<QWidget*>(watched);
    // A plot takes every wheel event, also those that zoom nothing, and lets none through.
    const auto* plot = qobject_cast<const QCustomPlot*>(widget);
    const bool still = plot != nullptr && !zoomsByWheel(*plot);
    if (still) widget->setAttribute(Qt::WA_NoMousePropagation, false);
    if (!still && (!isSetting(*widget) || widget->hasFocus())) return false;
    event->ignore();  // so that the widget around it gets the event
    return true;
}

}  // namespace tacto::gui

#include "moc_Style.cpp"
