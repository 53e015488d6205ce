// ToolRow.h - buttons in a row; those that do not fit stand in the menu of a "More" button at its end.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLayout>
#include <QToolButton>
#include <memory>
#include <set>
#include <vector>

namespace tacto::gui {

/// A button without an edge until it is hovered. `name` is for screen readers and for the "More" menu; without an icon
/// the text is the owner's.
[[nodiscard]] QToolButton* makeTool(const QString& name, const QString& tip, const QString& iconName, QWidget* parent);

class ToolRow final : public QLayout {
public:
    /// The parts that are added are buttons.
    explicit ToolRow(QWidget* parent);
    ~ToolRow() override;
    /// What follows is another group.
    void addGap();
    /// What follows stands at the right end. `part` has the room between, and gives way to the tools; once a row.
    void addBetween(QWidget* part);

    void addItem(QLayoutItem* item) override;
    int count() const override { return static_cast<int>(items_.size()); }
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    QSize sizeHint() const override;
    QSize minimumSize() const override;
    Qt::Orientations expandingDirections() const override;
    void setGeometry(const QRect& area) override;

private:
    /// How many of the parts have room in `width`, with the "More" button where that is not all of them.
    [[nodiscard]] std::size_t fitting(int width) const;
    [[nodiscard]] QSize wishOf(const QLayoutItem& item) const;
    void putAway(std::size_t from);
    void fillMenu();

    std::vector<std::unique_ptr<QLayoutItem>> items_;
    QToolButton* more_;
    QWidget* between_ = nullptr;
    std::size_t fits_ = 0;     // so many have room
    std::set<QWidget*> away_;  // hidden here, and shown again once there is room
};

}  // namespace tacto::gui
