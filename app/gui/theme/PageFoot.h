// PageFoot.h - what stands below a page and stays in sight: a line, and in a row what can be done with the page.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QBoxLayout>

namespace tacto::gui {

/// From the edges of a page to what stands in it.
inline constexpr int kPagePad = 16;

/// Adds the line and a row below it to `page`, the layout of `parent`, from edge to edge.
[[nodiscard]] QBoxLayout* addPageFoot(QVBoxLayout& page, QWidget* parent,
                                      QBoxLayout::Direction direction = QBoxLayout::LeftToRight);

}  // namespace tacto::gui
