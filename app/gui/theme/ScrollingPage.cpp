#include "app/gui/theme/ScrollingPage.h"

#include <algorithm>

namespace tacto::gui {

ScrollingPage::ScrollingPage(QWidget* parent) : QScrollArea(parent) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setFocusPolicy(Qt::NoFocus);
    setMinimumSize(1, 1);
}

void ScrollingPage::hold(QWidget* page) {
    setWidget(page);
    for (auto* ground : {page, viewport()}) ground->setAutoFillBackground(false);  // the workspace's own
}

int widthInSight(const QWidget& widget) {
    int width = widget.width();
    for (const auto* at = widget.parentWidget(); at != nullptr; at = at->parentWidget())
        if (const auto* page = qobject_cast<const ScrollingPage*>(at))
            width = std::min(width, page->viewport()->width());
    return width;
}

}  // namespace tacto::gui

#include "moc_ScrollingPage.cpp"
