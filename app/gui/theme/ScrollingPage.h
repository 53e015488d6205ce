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
    explicit ScrollingPage(QWidget* parent);
    /// Takes the page. One that was made with viewport() as its parent stays where it is; any other moves here, and
    /// each widget in it takes its style again.
    void hold(QWidget* page);
    /// None of the page's: one that stands within another scrolls by itself.
    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
};

/// The widget's width, or that of the scrolling page around it where that is less: what has to suit the room goes by
/// this, for a page is never narrower than what stands in it.
[[nodiscard]] int widthInSight(const QWidget& widget);

}  // namespace tacto::gui
