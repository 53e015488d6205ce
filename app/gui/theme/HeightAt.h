// HeightAt.h - how high a layout is at a width: words that wrap make it higher where it is narrow.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLayout>

namespace tacto::gui {

[[nodiscard]] inline int wholeHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalHeightForWidth(width) : layout.totalSizeHint().height();
}
/// With all that scrolls or stretches as low as it may be.
[[nodiscard]] inline int leastHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalMinimumHeightForWidth(width) : layout.totalMinimumSize().height();
}

}  // namespace tacto::gui
