#include "app/gui/look/TableText.h"

#include <QHeaderView>
#include <QStyle>

namespace tacto::gui {

void putText(QTableWidget& table, int row, int column, const QString& text, bool right) {
    auto* item = new QTableWidgetItem(text);
    item->setTextAlignment((right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    table.setItem(row, column, item);
}

void fitToRows(QTableWidget& table) {
    table.resizeColumnsToContents();
    table.resizeRowsToContents();
    int height = table.horizontalHeader()->sizeHint().height() + 2 * table.frameWidth();
    for (int row = 0; row < table.rowCount(); ++row) height += table.rowHeight(row);
    int width = 2 * table.frameWidth();
    for (int column = 0; column < table.columnCount(); ++column) width += table.columnWidth(column);
    table.setMaximumWidth(width);
    table.setFixedHeight(height + table.style()->pixelMetric(QStyle::PM_ScrollBarExtent) / 2);
}

}  // namespace tacto::gui
