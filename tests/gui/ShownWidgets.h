// ShownWidgets.h - visits what is visible in a window when its looks are tested: widgets, views, cells.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QAbstractItemView>
#include <QHeaderView>
#include <QLineEdit>
#include <QTreeView>
#include <algorithm>

namespace tacto::test {

template <class T, class Follow>
void forEachShown(const QWidget& in, Follow follow) {
    for (auto* widget : in.findChildren<T*>())
        if (widget->isVisible() && widget->window() == in.window()) follow(*widget);
}

template <class Follow>
void forEachCell(const QAbstractItemView& view, const QModelIndex& parent, Follow follow) {
    const auto* model = view.model();
    constexpr int kRows = 500;  // more rows are never in sight
    for (int row = 0; row < std::min(model->rowCount(parent), kRows); ++row) {
        for (int column = 0; column < model->columnCount(parent); ++column) follow(model->index(row, column, parent));
        const auto first = model->index(row, 0, parent);
        const auto* tree = qobject_cast<const QTreeView*>(&view);
        if (tree != nullptr && tree->isExpanded(first)) forEachCell(view, first, follow);
    }
}

/// Visits views that show cells; a header is part of its view.
template <class Follow>
void forEachView(const QWidget& in, Follow follow) {
    forEachShown<QAbstractItemView>(in, [&](const QAbstractItemView& view) {
        if (qobject_cast<const QHeaderView*>(&view) == nullptr && view.model() != nullptr) follow(view);
    });
}

/// Returns "QTableWidget in QWidget sessionsPage": class and name, or the parent if there is no name.
[[nodiscard]] QString called(const QWidget& widget);
/// Returns '"a text" in …: 12 of 17 px'.
[[nodiscard]] QString cutOf(const QString& what, const QWidget& at, int has, int needs);
/// The room for text, without frame, margins and buttons.
[[nodiscard]] QSize roomForText(const QLineEdit& edit);

}  // namespace tacto::test
