#include "app/gui/theme/Pages.h"

#include <QAccessible>
#include <QAccessibleWidget>
#include <algorithm>
#include <mutex>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

/// What a screen reader sees of a scroll area. Qt's own (6.4) reads past the end of its list where the reader asks for
/// a scroll bar that has been hidden since it was counted.
QAccessibleInterface* seenArea(const QString& name, QObject* object) {
    if (name != "QScrollArea" || !object->isWidgetType()) return nullptr;
    return new QAccessibleWidget(static_cast<QWidget*>(object), QAccessible::Client);
}

}  // namespace

ScrollingPage::ScrollingPage(QWidget* parent) : QScrollArea(parent) {
    static std::once_flag installed;
    std::call_once(installed, [] { QAccessible::installFactory(seenArea); });
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setFocusPolicy(Qt::NoFocus);
    setMinimumSize(1, 1);
}

void ScrollingPage::hold(QWidget* page) {
    setWidget(page);
    for (auto* ground : {page, viewport()}) ground->setAutoFillBackground(false);  // the workspace's shows
}

void scrollDownOnly(QScrollArea& area) {
    area.setFrameShape(QFrame::NoFrame);
    area.setWidgetResizable(true);
    area.setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

QScrollArea* scrollingRows(QWidget* rows, QWidget* parent) {
    auto* area = new QScrollArea(parent);
    scrollDownOnly(*area);
    area->setMinimumHeight(1);
    area->setWidget(rows);
    return area;
}

int widthInSight(const QWidget& widget) {
    int width = widget.width();
    for (const auto* at = widget.parentWidget(); at != nullptr; at = at->parentWidget())
        if (const auto* page = qobject_cast<const ScrollingPage*>(at))
            width = std::min(width, page->viewport()->width());
    return width;
}

QBoxLayout* addPageFoot(QVBoxLayout& page, QWidget* parent, QBoxLayout::Direction direction) {
    page.addWidget(lineAcross(parent));
    auto* foot = new QBoxLayout(direction);
    foot->setContentsMargins(kPagePad, 12, kPagePad, 12);
    foot->setSpacing(8);
    page.addLayout(foot);
    return foot;
}

namespace {

class ShownPage final : public QStackedLayout {
public:
    using QStackedLayout::QStackedLayout;
    [[nodiscard]] QSize sizeHint() const override { return item() == nullptr ? QSize() : item()->sizeHint(); }
    [[nodiscard]] QSize minimumSize() const override { return item() == nullptr ? QSize() : item()->minimumSize(); }
    [[nodiscard]] bool hasHeightForWidth() const override { return item() != nullptr && item()->hasHeightForWidth(); }
    [[nodiscard]] int heightForWidth(int width) const override {
        return hasHeightForWidth() ? item()->heightForWidth(width) : -1;
    }

private:
    [[nodiscard]] QLayoutItem* item() const { return itemAt(currentIndex()); }
};

}  // namespace

PageStack::PageStack(QWidget* parent) : QWidget(parent), pages_(new ShownPage(this)) {
    connect(pages_, &QStackedLayout::currentChanged, pages_, &QLayout::update);
}

}  // namespace tacto::gui

#include "moc_Pages.cpp"
