#include "app/gui/theme/MnemonicStyle.h"

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>

namespace tacto::gui {

MnemonicStyle::MnemonicStyle() : QProxyStyle("Fusion") { qApp->installEventFilter(this); }

int MnemonicStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                             QStyleHintReturn* returned) const {
    return hint == SH_UnderlineShortcut ? int(held_) : QProxyStyle::styleHint(hint, option, widget, returned);
}

bool MnemonicStyle::eventFilter(QObject* watched, QEvent* event) {
    const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease;
    if (key && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Alt) underline(event->type() == QEvent::KeyPress);
    // Where Alt takes the focus elsewhere (Alt+Tab), its release does not come here.
    if (event->type() == QEvent::ApplicationStateChange) underline(false);
    return QProxyStyle::eventFilter(watched, event);
}

void MnemonicStyle::underline(bool held) {
    if (held == std::exchange(held_, held)) return;
    for (auto* widget : QApplication::allWidgets()) {
        if (widget->isVisible()) widget->update();
    }
}

}  // namespace tacto::gui
