#include "app/gui/theme/PageStack.h"

namespace tacto::gui {

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

#include "moc_PageStack.cpp"
