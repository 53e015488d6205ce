// Pages.h - pages that scroll, stacks that show one of several pages, and the bar at the foot of a page.
#pragma once

#include <QBoxLayout>
#include <QLayout>
#include <QScrollArea>
#include <QStackedLayout>
#include <QWidget>

namespace tacto::gui {

/// A page that scrolls if there is too little room, so that no page makes the window larger than the screen.
class ScrollingPage final : public QScrollArea {
    Q_OBJECT
public:
    explicit ScrollingPage(QWidget* parent);
    /// Sets the page. Make it with viewport() as its parent; otherwise it is moved here, and each widget in it must be
    /// styled again.
    void hold(QWidget* page);
    /// Asks only for its least size, because its content can scroll.
    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
};

/// Makes the area as wide as its page, without a frame, and lets it scroll only up and down.
void scrollDownOnly(QScrollArea& area);
/// Makes a list of rows that is as wide as its place, scrolls if there is too little room, and takes the arrow keys.
[[nodiscard]] QScrollArea* scrollingRows(QWidget* rows, QWidget* parent);

/// Returns the visible width: that of the widget, or of the scrolling page around it if that is smaller. Use it to fit
/// things to the room, because a page is never narrower than its content.
[[nodiscard]] int widthInSight(const QWidget& widget);

/// Returns the height of a layout at a width, because wrapped text is higher in a narrow layout.
[[nodiscard]] inline int wholeHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalHeightForWidth(width) : layout.totalSizeHint().height();
}
/// Returns the height if everything that can scroll or stretch is as low as possible.
[[nodiscard]] inline int leastHeightAt(const QLayout& layout, int width) {
    return layout.hasHeightForWidth() ? layout.totalMinimumHeightForWidth(width) : layout.totalMinimumSize().height();
}

/// The distance from the edges of a page to its content.
inline constexpr int kPagePad = 16;

/// Adds a foot that stays visible below a page to `page`, the layout of `parent`, from edge to edge: a separating line,
/// and below it a row for the page's buttons. Returns the row.
[[nodiscard]] QBoxLayout* addPageFoot(QVBoxLayout& page, QWidget* parent,
                                      QBoxLayout::Direction direction = QBoxLayout::LeftToRight);

/// Shows one of several pages and asks only for that page's room, so that a large hidden page does not make others
/// scroll.
class PageStack : public QWidget {
    Q_OBJECT
public:
    explicit PageStack(QWidget* parent = nullptr);
    /// Adds a page; the first one is shown.
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
