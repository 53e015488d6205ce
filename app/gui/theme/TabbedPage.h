// TabbedPage.h - pages behind tabs, each with its own tools in the row of the tabs, or below it where there is no room.
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
    /// The parent to make a page with: a page that is moved here later takes longer.
    [[nodiscard]] QWidget* room() const { return pages_; }
    /// Takes both; `tools` may be null.
    void addTab(QWidget* page, const QString& title, QWidget* tools = nullptr);
    /// The row of tabs and tools. The tabs' keys work without it.
    void setHeadVisible(bool visible);
    /// Takes the height that the window leaves: a page whose words wrap would ask for all that its plot likes to have.
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
    std::vector<QShortcut*> keys_;  ///< keys for the tabs while their row is hidden; otherwise the tab bar has them
};

/// The order of Tab where widgets are made late: Qt puts each one that is made at the end of its window. Tab goes from
/// `before` through what stands in `place`, in the order in which that was made, and then to what came after `before`.
/// Call it again when `place` holds something new. Neither has to take the focus itself.
void tabAfter(QWidget& before, QWidget& place);
/// Sets the order where `place` itself stands in it.
inline void tabInPlace(QWidget& place) { tabAfter(place, place); }

}  // namespace tacto::gui
