// TabbedPage.h - pages with tabs, each with its own tools in the row of the tabs, or below it in a narrow window.
#pragma once

#include <QShortcut>
#include <QTabBar>
#include <QWidget>
#include <vector>

#include "app/gui/theme/Pages.h"

namespace tacto::gui {

class TabbedPage final : public QWidget {
    Q_OBJECT
public:
    explicit TabbedPage(QWidget* parent);
    /// The parent for a new page; moving a page here later takes longer.
    [[nodiscard]] QWidget* room() const { return pages_; }
    /// Adds a page and its tools, and takes both over; `tools` may be null.
    void addTab(QWidget* page, const QString& title, QWidget* tools = nullptr);
    /// Shows or hides the row of tabs and tools. The keys of the tabs still work without the row.
    void setHeadVisible(bool visible);
    /// Uses the height that the window leaves: a page with wrapped text would otherwise ask for far too much.
    [[nodiscard]] bool hasHeightForWidth() const override { return false; }
    void setCurrentIndex(int index) { bar_->setCurrentIndex(index); }
    [[nodiscard]] int currentIndex() const { return bar_->currentIndex(); }
    [[nodiscard]] QTabBar& bar() const { return *bar_; }
    /// Null without pages.
    [[nodiscard]] QWidget* currentPage() const { return pages_->currentWidget(); }

signals:
    void currentChanged(int index);

private:
    QWidget* head_;
    QTabBar* bar_;
    PageStack* tools_;
    PageStack* pages_;
    std::vector<QShortcut*> keys_;  ///< keys for the tabs while their row is hidden; otherwise the tab bar handles them
};

/// Sets the tab order for widgets that are made late, which Qt puts at the end of their window. Tab goes from `before`
/// through the widgets in `place`, in the order in which they were made, and then to the former successor of `before`.
/// Call it again after adding to `place`. Neither argument needs to take the focus itself.
void tabAfter(QWidget& before, QWidget& place);
/// The same if `place` itself is already at its place in the tab order.
inline void tabInPlace(QWidget& place) { tabAfter(place, place); }

}  // namespace tacto::gui
