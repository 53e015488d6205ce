// RecordColumns.h - shows records in a table, with the columns of a list. Keys of records are never shown.
#pragma once

#include <QTableWidget>

#include "app/report/ResultCells.h"

namespace tacto::gui {

/// Makes a table that cannot be edited and has no scroll bars: all rows are visible, and the last text column takes the
/// remaining room and is shortened with "…". Takes ownership through `parent`.
[[nodiscard]] QTableWidget* makeRecordTable(const std::vector<ResultColumn>& columns, const nlohmann::json& records,
                                            QWidget* parent);
/// Replaces headers and cells of a table that scrolls in its own place.
void fillRecordTable(QTableWidget& table, const std::vector<ResultColumn>& columns, const nlohmann::json& records);
/// Fits header, rows and columns of such a table to their content in the current text size.
void fitRecordTable(QTableWidget& table);
/// Lays out a table filled with putText() in the same way. `room_px`: the width available to the table.
void layOutRecordTable(QTableWidget& table, int room_px = QWIDGETSIZE_MAX);
void putText(QTableWidget& table, int row, int column, const QString& text, bool right);

}  // namespace tacto::gui
