// PageStack.h - pages of which one is shown. It asks for the room of that page alone: a hidden page that is wide or
// high makes no other scroll.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStackedLayout>
#include <QWidget>

namespace tacto::gui {

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

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    QStackedLayout* pages_;
};

}  // namespace tacto::gui
