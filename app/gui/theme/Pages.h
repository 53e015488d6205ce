// Pages.h - pages that scroll, stacks that show one page, and the bar below a page.
#pragma once

#include <QBoxLayout>
#include <QLayout>
#include <QScrollArea>
#include <QStackedLayout>
#include <QWidget>

namespace tacto::gui {

/// A page with scroll bars where there is less room than it needs: no page makes the window larger than the screen.
class ScrollingPage final : public QScrollArea {
    Q_OBJECT
public:
    explicit ScrollingPage(QWidget* parent);
    /// Takes the page. One that was made with viewport() as its parent stays where it is; any other moves here, and
    /// each widget in it takes its style again.
    void hold(QWidget* page);
    /// Whether it stands on the page itself: one that stands within another scrolls by itself.
    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
};

/// Of its page's width, without a frame; from top to bottom only.
void scrollDownOnly(QScrollArea& area);
/// A list of rows that scrolls where it has less room than it needs, as wide as its place, and takes the arrow keys.
[[nodiscard]] QScrollArea* scrollingRows(QWidget* rows, QWidget* parent);

/// The width of the widget, or of the scrolling page around it if that is less: whatever has to suit the room goes by
/// this, since a page is never narrower than its content.
[[nodiscard]] int widthInSight(const QWidget& widget);

/// How high a layout is at a width: words that wrap make it higher where it is narrow.
[[nodiscard]] inline int wholeHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalHeightForWidth(width) : layout.totalSizeHint().height();
}
/// The height with all that scrolls or stretches as low as it may be.
[[nodiscard]] inline int leastHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalMinimumHeightForWidth(width) : layout.totalMinimumSize().height();
}

/// The distance from the edges of a page to its content.
inline constexpr int kPagePad = 16;

/// Adds what stands below a page and stays in sight to `page`, the layout of `parent`, from edge to edge: a line, and
/// below it a row for what can be done with the page.
[[nodiscard]] QBoxLayout* addPageFoot(QVBoxLayout& page, QWidget* parent,
                                      QBoxLayout::Direction direction = QBoxLayout::LeftToRight);

/// Pages of which one is shown. It asks for the room of that page alone: a hidden wide or high page makes no other
/// scroll.
class PageStack : public QWidget {
    Q_OBJECT
public:
    explicit PageStack(QWidget* parent = nullptr);
    /// Takes it; the first one is shown.
    void addWidget(QWidget* page) { pages_->addWidget(page); }
    void setCurrentIndex(int index) { pages_->setCurrentIndex(index); }
    /// -1 without pages.
    [[nodiscard]] int currentIndex() const { return pages_->currentIndex(); }
    /// Null without pages.
    [[nodiscard]] QWidget* currentWidget() const { return pages_->currentWidget(); }
    [[nodiscard]] QWidget* widget(int index) const { return pages_->widget(index); }
    [[nodiscard]] int indexOf(const QWidget* page) const { return pages_->indexOf(page); }

private:
    QStackedLayout* pages_;
};

}  // namespace tacto::gui
