// ToolRow.h - rows of widgets that adapt to the available width.
#pragma once

#include <QBoxLayout>
#include <QToolButton>
#include <functional>
#include <memory>
#include <set>
#include <vector>

namespace tacto::gui {

/// Makes a button without an edge until the pointer is over it. `name` is for screen readers and the "More" menu;
/// without an icon the owner sets the text.
[[nodiscard]] QToolButton* makeTool(const QString& name, const QString& tip, const QString& iconName, QWidget* parent);

/// A row of buttons; those that do not fit move into the menu of a "More" button at the end.
class ToolRow final : public QLayout {
public:
    /// All parts added to the row must be buttons.
    explicit ToolRow(QWidget* parent);
    ~ToolRow() override;
    /// Starts another group of tools.
    void addGap();
    /// Puts the next tools at the right end. `part` takes the space between and shrinks first. Call it once per row.
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
    /// Number of parts that fit into `width`, together with the "More" button if not all fit.
    [[nodiscard]] std::size_t fitting(int width) const;
    [[nodiscard]] QSize wishOf(const QLayoutItem& item) const;
    void putAway(std::size_t from);
    void fillMenu();

    std::vector<std::unique_ptr<QLayoutItem>> items_;
    QToolButton* more_;
    QWidget* between_ = nullptr;
    std::size_t fits_ = 0;     // number of parts that fit
    std::set<QWidget*> away_;  // hidden by this row until there is room again
};

/// Widgets side by side if there is room, else one below the other.
class TurningRow final : public QBoxLayout {
    Q_OBJECT
public:
    /// `from`: returns the width from which the parts stand side by side; called at each layout, because it may depend
    /// on the text size. Without `from`: the width that the parts prefer.
    explicit TurningRow(std::function<int()> from = {}, QWidget* parent = nullptr)
        : QBoxLayout(LeftToRight, parent), from_(std::move(from)) {}
    void setGeometry(const QRect& room) override;
    /// The size from which the parts stand side by side, however they stand now.
    [[nodiscard]] QSize sizeHint() const override;
    /// The width of the widest part, however the parts stand now: the row can always turn.
    [[nodiscard]] QSize minimumSize() const override;

signals:
    /// The direction of the row has changed.
    void turned(bool beside);

private:
    [[nodiscard]] int from() const;
    std::function<int()> from_;
};

}  // namespace tacto::gui
