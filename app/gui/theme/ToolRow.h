// ToolRow.h - rows of parts that suit the room they have.
#pragma once

#include <QBoxLayout>
#include <QToolButton>
#include <functional>
#include <memory>
#include <set>
#include <vector>

namespace tacto::gui {

/// A button without an edge until it is hovered. `name` is for screen readers and for the "More" menu; without an icon
/// the text is the owner's.
[[nodiscard]] QToolButton* makeTool(const QString& name, const QString& tip, const QString& iconName, QWidget* parent);

/// Buttons in a row; those that do not fit stand in the menu of a "More" button at its end.
class ToolRow final : public QLayout {
public:
    /// The parts that are added are buttons.
    explicit ToolRow(QWidget* parent);
    ~ToolRow() override;
    /// The next tools belong to another group.
    void addGap();
    /// The next tools stand at the right end. `part` has the room between, and gives way to the tools; once a row.
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
    /// How many of the parts have room in `width`, with the "More" button where not all of them do.
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

/// Parts beside each other where there is room, else one below the other.
class TurningRow final : public QBoxLayout {
    Q_OBJECT
public:
    /// `from`: the width from which its parts stand beside each other, asked whenever it is laid out: it may follow the
    /// size of text. Without it: as wide as its parts like to be.
    explicit TurningRow(std::function<int()> from = {}, QWidget* parent = nullptr)
        : QBoxLayout(LeftToRight, parent), from_(std::move(from)) {}
    void setGeometry(const QRect& room) override;
    /// The size from which its parts stand beside each other, whichever way they stand now.
    [[nodiscard]] QSize sizeHint() const override;
    /// The width of its widest part, whichever way it stands: it can always turn.
    [[nodiscard]] QSize minimumSize() const override;

signals:
    /// The row stands the other way now.
    void turned(bool beside);

private:
    [[nodiscard]] int from() const;
    std::function<int()> from_;
};

}  // namespace tacto::gui
