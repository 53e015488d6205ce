#include "app/gui/look/TableText.h"

#include <QHeaderView>
#include <QScrollBar>

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
    auto* across = table.horizontalScrollBar();
    const auto giveRoom = [&table, across, height](int, int most) {
        table.setFixedHeight(height + (most > 0 ? across->sizeHint().height() : 0));
    };
    QObject::connect(across, &QScrollBar::rangeChanged, &table, giveRoom);
    giveRoom(0, across->maximum());
}

}  // namespace tacto::gui
