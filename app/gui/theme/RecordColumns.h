// RecordColumns.h - records as a table of the window, by a list of columns. No key of a record is ever shown.
#pragma once

#include <QTableWidget>

#include "app/report/ResultCells.h"

namespace tacto::gui {

/// A table that cannot be edited and has no scroll bars of its own: all rows are in sight, and the last column of words
/// takes the room that is left and elides. Takes `parent`.
[[nodiscard]] QTableWidget* makeRecordTable(const std::vector<ResultColumn>& columns, const nlohmann::json& records,
                                            QWidget* parent);
/// Headers and cells of a table that scrolls in its own place and has other rows now.
void fillRecordTable(QTableWidget& table, const std::vector<ResultColumn>& columns, const nlohmann::json& records);
/// Makes header, rows and columns of such a table as large as what is in them, in the current size of text.
void fitRecordTable(QTableWidget& table);
/// Lays out a table that is filled by hand, with putText(), alike. `room_px`: no more than it has where it stands.
void layOutRecordTable(QTableWidget& table, int room_px = QWIDGETSIZE_MAX);
void putText(QTableWidget& table, int row, int column, const QString& text, bool right);

}  // namespace tacto::gui
