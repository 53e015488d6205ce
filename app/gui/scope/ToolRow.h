// ToolRow.h - buttons in a row that goes on in the next line where the window is too narrow: nothing is folded away.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLayout>
#include <memory>
#include <vector>

namespace tacto::gui {

class ToolRow final : public QLayout {
public:
    explicit ToolRow(QWidget* parent);
    ~ToolRow() override;
    /// Room as wide as a letter: what follows is another group.
    void addGap();

    void addItem(QLayoutItem* item) override;
    int count() const override { return static_cast<int>(items_.size()); }
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    QSize sizeHint() const override;
    QSize minimumSize() const override;
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override { return lay(QRect(0, 0, width, 0), false); }
    Qt::Orientations expandingDirections() const override { return {}; }
    void setGeometry(const QRect& area) override;

private:
    /// The height that it takes; `really`: items are moved there.
    int lay(const QRect& area, bool really) const;

    std::vector<std::unique_ptr<QLayoutItem>> items_;
};

}  // namespace tacto::gui
