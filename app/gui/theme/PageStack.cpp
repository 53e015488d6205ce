#include "app/gui/theme/PageStack.h"

#include <QResizeEvent>
#include <algorithm>

namespace tacto::gui {

namespace {

class ShownPage final : public QStackedLayout {
public:
    using QStackedLayout::QStackedLayout;
    [[nodiscard]] QSize sizeHint() const override { return item() == nullptr ? QSize() : item()->sizeHint(); }
    /// With the height of words that wrap at the present width, also where the page around it does not ask for that.
    [[nodiscard]] QSize minimumSize() const override {
        if (item() == nullptr) return {};
        auto size = item()->minimumSize();
        const auto* page = item()->widget()->layout();
        if (page != nullptr && page->hasHeightForWidth() && geometry().width() > 0)
            size.setHeight(std::max(size.height(), page->totalMinimumHeightForWidth(geometry().width())));
        return size;
    }
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

void PageStack::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) pages_->update();
}

}  // namespace tacto::gui

#include "moc_PageStack.cpp"
