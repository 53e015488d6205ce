// ScrollingPage.h - a page with scroll bars where there is less room than it needs: no page makes the window larger
// than the screen.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QScrollArea>

namespace tacto::gui {

class ScrollingPage final : public QScrollArea {
    Q_OBJECT
public:
    /// Takes the page.
    ScrollingPage(QWidget* page, QWidget* parent);
    /// None of the page's: one that stands within another scrolls by itself.
    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
};

}  // namespace tacto::gui
