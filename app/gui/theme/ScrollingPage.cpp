#include "app/gui/theme/ScrollingPage.h"

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

}  // namespace tacto::gui

#include "moc_ScrollingPage.cpp"
