#include "app/gui/theme/TabOrder.h"

namespace tacto::gui {

namespace {

/// Returns the last one.
QWidget* chain(QWidget* before, const QWidget& place) {
    for (auto* each : place.findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        if (each->isWindow()) continue;
        // A part that hands its focus on is reached with what it hands it to.
        if ((each->focusPolicy() & Qt::TabFocus) != 0 && each->focusProxy() == nullptr) {
            QWidget::setTabOrder(before, each);
            before = each;
        }
        before = chain(before, *each);
    }
    return before;
}

}  // namespace

void tabAfter(QWidget& before, QWidget& place) {
    // setTabOrder() takes none that has no focus: the last one before it that has.
    auto* last = &before;
    do {
        if (last->focusPolicy() != Qt::NoFocus) break;
        last = last->previousInFocusChain();
    } while (last != &before);
    chain(last, place);
}

}  // namespace tacto::gui
