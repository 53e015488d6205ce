// TableText.h - tables of results inside a page: texts in cells, and all rows in sight.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTableWidget>

namespace tacto::gui {

void putText(QTableWidget& table, int row, int column, const QString& text, bool right);

/// All rows in sight: the page scrolls, not the table. Leaves room for its sideways scroll bar, where the page is
/// narrower than it.
void fitToRows(QTableWidget& table);

}  // namespace tacto::gui
