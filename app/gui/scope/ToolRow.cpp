#include "app/gui/scope/ToolRow.h"

#include <QSpacerItem>
#include <QWidget>
#include <algorithm>
#include <utility>
#include <vector>

namespace tacto::gui {

ToolRow::ToolRow(QWidget* parent) : QLayout(parent) {
    setContentsMargins(0, 0, 0, 0);
    setSpacing(2);
}

ToolRow::~ToolRow() = default;

void ToolRow::addGap() {
    const int width = parentWidget()->fontMetrics().averageCharWidth();
    items_.push_back(std::make_unique<QSpacerItem>(width, 0, QSizePolicy::Fixed, QSizePolicy::Fixed));
    invalidate();
}

void ToolRow::addItem(QLayoutItem* item) { items_.emplace_back(item); }

QLayoutItem* ToolRow::itemAt(int index) const {
    return index >= 0 && index < count() ? items_[static_cast<std::size_t>(index)].get() : nullptr;
}

QLayoutItem* ToolRow::takeAt(int index) {
    if (index < 0 || index >= count()) return nullptr;
    auto* taken = items_[static_cast<std::size_t>(index)].release();
    items_.erase(items_.begin() + index);
    return taken;
}

QSize ToolRow::sizeHint() const {
    QSize hint;
    for (const auto& item : items_) {
        const auto its = item->sizeHint();
        hint = {hint.width() + its.width() + spacing(), std::max(hint.height(), its.height())};
    }
    return hint;
}

QSize ToolRow::minimumSize() const {
    QSize least;
    for (const auto& item : items_) least = least.expandedTo(item->minimumSize());
    return least;
}

void ToolRow::setGeometry(const QRect& area) {
    QLayout::setGeometry(area);
    lay(area, true);
}

int ToolRow::lay(const QRect& area, bool really) const {
    int x = area.left(), y = area.top(), line = 0;
    std::vector<std::pair<QLayoutItem*, QRect>> inLine;
    const auto setLine = [&] {  // on one middle line, however high each is
        for (const auto& [item, at] : inLine) item->setGeometry(at.translated(0, (line - at.height()) / 2));
        inLine.clear();
    };
    for (const auto& item : items_) {
        const auto size = item->sizeHint();
        const bool gap = item->spacerItem() != nullptr;
        if (x > area.left() && x + size.width() > area.right() + 1) {
            setLine();
            x = area.left();
            y += line + spacing();
            line = 0;
            if (gap) continue;  // a new line is gap enough
        }
        if (really) inLine.emplace_back(item.get(), QRect(QPoint(x, y), size));
        x += size.width() + spacing();
        line = std::max(line, size.height());
    }
    setLine();
    return y + line - area.top();
}

}  // namespace tacto::gui
