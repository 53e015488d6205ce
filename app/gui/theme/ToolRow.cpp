#include "app/gui/theme/ToolRow.h"

#include <QMenu>
#include <QSpacerItem>
#include <QWidget>
#include <algorithm>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"

namespace tacto::gui {

namespace {

constexpr int kBetweenTools = 0, kBetweenGroups = 8;

}  // namespace

QToolButton* makeTool(const QString& name, const QString& tip, const QString& iconName, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setAccessibleName(name);
    button->setToolTip(tip);
    if (!iconName.isEmpty()) button->setIcon(icon(iconName));
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

ToolRow::ToolRow(QWidget* parent) : QLayout(parent), more_(new QToolButton(parent)) {
    setContentsMargins(0, 0, 0, 0);
    setSpacing(kBetweenTools);
    nameWidget(*more_, "moreTools", QObject::tr("More tools"), QObject::tr("The tools that have no room in this row."));
    more_->setIcon(icon("more"));
    more_->setAutoRaise(true);
    more_->setFocusPolicy(Qt::StrongFocus);
    more_->setPopupMode(QToolButton::InstantPopup);
    more_->setProperty("role", "opens");
    auto* menu = new QMenu(more_);
    menu->setToolTipsVisible(true);
    QObject::connect(menu, &QMenu::aboutToShow, more_, [this] { fillMenu(); });
    more_->setMenu(menu);
    more_->hide();
}

ToolRow::~ToolRow() = default;

void ToolRow::addGap() {
    items_.push_back(std::make_unique<QSpacerItem>(kBetweenGroups, 0, QSizePolicy::Fixed, QSizePolicy::Fixed));
    invalidate();
}

void ToolRow::addBetween(QWidget* part) {
    addWidget(part);
    between_ = part;
    addGap();
}

Qt::Orientations ToolRow::expandingDirections() const {
    return between_ != nullptr ? Qt::Horizontal : Qt::Orientations();
}

/// Returns the width that the item wants, even if it is hidden.
QSize ToolRow::wishOf(const QLayoutItem& item) const {
    auto* part = const_cast<QLayoutItem&>(item).widget();
    if (part == nullptr) return item.sizeHint();
    if (part == between_) return {0, part->sizeHint().height()};
    return part->sizeHint().expandedTo(part->minimumSize()).boundedTo(part->maximumSize());
}

/// "More" stands behind all parts, also for the tab key.
void ToolRow::addItem(QLayoutItem* item) {
    items_.emplace_back(item);
    if (auto* part = item->widget(); part != nullptr) QWidget::setTabOrder(part, more_);
    more_->raise();
}

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
        const auto its = wishOf(*item);
        hint = {hint.width() + its.width() + spacing(), std::max(hint.height(), its.height())};
    }
    return hint;
}

/// The first part and the "More" button.
QSize ToolRow::minimumSize() const {
    if (items_.empty()) return {};
    return {wishOf(*items_.front()).width() + spacing() + more_->sizeHint().width(), sizeHint().height()};
}

std::size_t ToolRow::fitting(int width) const {
    if (sizeHint().width() - spacing() <= width) return items_.size();
    int left = width - more_->sizeHint().width();
    std::size_t fits = 0;
    while (fits < items_.size() && left >= wishOf(*items_[fits]).width() + spacing())
        left -= wishOf(*items_[fits++]).width() + spacing();
    return std::max<std::size_t>(fits, 1);
}

/// Places the parts that fit now. Shows or hides parts in the next turn of the event loop, because that makes the
/// parent lay out again.
void ToolRow::setGeometry(const QRect& area) {
    QLayout::setGeometry(area);
    const auto fits = fitting(area.width());
    int x = area.left();
    const auto next = [&](const QSize& size) {
        const QRect at(QPoint(x, area.top() + (area.height() - size.height()) / 2), size);
        x += size.width() + spacing();
        return at;
    };
    const int left = fits < items_.size() ? 0 : std::max(0, area.width() - sizeHint().width());
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const QSize more(between_ != nullptr && items_[i]->widget() == between_ ? left : 0, 0);
        if (i < fits)
            items_[i]->setGeometry(next(wishOf(*items_[i]) + more));
        else
            items_[i]->setGeometry(QRect(area.topLeft(), QSize(0, 0)));
    }
    if (fits < items_.size()) more_->setGeometry(next(more_->sizeHint()));
    if (std::exchange(fits_, fits) == fits) return;
    QMetaObject::invokeMethod(
        more_, [this] { putAway(fits_); }, Qt::QueuedConnection);
}

void ToolRow::putAway(std::size_t from) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
        auto* part = items_[i]->widget();
        if (part == nullptr) continue;
        if (i < from && away_.erase(part) > 0) part->show();
        if (i >= from && !part->isHidden()) {
            away_.insert(part);
            part->hide();
        }
    }
    more_->setVisible(from < items_.size());
}

void ToolRow::fillMenu() {
    auto& menu = *more_->menu();
    menu.clear();
    for (const auto& item : items_) {
        auto* button = qobject_cast<QAbstractButton*>(item->widget());
        if (button == nullptr || !away_.contains(button)) continue;
        auto* action = menu.addAction(button->icon(), button->accessibleName());
        action->setToolTip(button->toolTip());
        action->setEnabled(button->isEnabled());
        const auto* tool = qobject_cast<const QToolButton*>(button);
        if (tool != nullptr && tool->menu() != nullptr) {
            action->setMenu(tool->menu());
            continue;
        }
        action->setCheckable(button->isCheckable());
        action->setChecked(button->isChecked());
        QObject::connect(action, &QAction::triggered, button, &QAbstractButton::click);
    }
}

void TurningRow::setGeometry(const QRect& room) {
    const bool beside = room.width() >= from();
    if (beside != (direction() == LeftToRight)) {
        setDirection(beside ? LeftToRight : TopToBottom);
        emit turned(beside);
    }
    QBoxLayout::setGeometry(room);
}

int TurningRow::from() const {
    if (from_) return from_();
    int all = 0, parts = 0;
    for (int at = 0; at < count(); ++at) {
        if (itemAt(at)->isEmpty()) continue;
        all += itemAt(at)->sizeHint().width();
        ++parts;
    }
    return all + std::max(0, parts - 1) * spacing();
}

QSize TurningRow::sizeHint() const {
    const auto hint = QBoxLayout::sizeHint();
    return {std::max(hint.width(), from()), hint.height()};
}

QSize TurningRow::minimumSize() const {
    int widest = 0;
    for (int at = 0; at < count(); ++at)
        if (!itemAt(at)->isEmpty()) widest = std::max(widest, itemAt(at)->minimumSize().width());
    const auto margins = contentsMargins();
    return {widest + margins.left() + margins.right(), QBoxLayout::minimumSize().height()};
}

}  // namespace tacto::gui

#include "moc_ToolRow.cpp"
