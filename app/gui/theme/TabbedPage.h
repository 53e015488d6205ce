// TabbedPage.h - pages behind tabs, each with its own tools in the row of the tabs.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStackedWidget>
#include <QTabBar>
#include <QWidget>

#include "app/gui/theme/TabKeys.h"

namespace tacto::gui {

class TabbedPage final : public QWidget {
    Q_OBJECT
public:
    explicit TabbedPage(QWidget* parent);
    /// The parent to make a page with: moved here once it is made, it takes longer.
    [[nodiscard]] QWidget* room() const { return pages_; }
    /// Takes both; `tools` may be null.
    void addTab(QWidget* page, const QString& title, QWidget* tools = nullptr);
    /// The row of tabs and tools. The tabs' keys work without it.
    void setHeadVisible(bool visible);
    void setCurrentIndex(int index) { bar_->setCurrentIndex(index); }
    [[nodiscard]] int currentIndex() const { return bar_->currentIndex(); }

signals:
    void currentChanged(int index);

private:
    QWidget* head_;
    QTabBar* bar_;
    QStackedWidget* tools_;
    QStackedWidget* pages_;
    TabKeys keys_{*this, [this](int index) { setCurrentIndex(index); }};
};

}  // namespace tacto::gui
