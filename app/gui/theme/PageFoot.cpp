#include "app/gui/theme/PageFoot.h"

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

QBoxLayout* addPageFoot(QVBoxLayout& page, QWidget* parent, QBoxLayout::Direction direction) {
    page.addWidget(lineAcross(parent));
    auto* foot = new QBoxLayout(direction);
    foot->setContentsMargins(kPagePad, 12, kPagePad, 12);
    foot->setSpacing(8);
    page.addLayout(foot);
    return foot;
}

}  // namespace tacto::gui
