// RecordColumns.h - records as a table by a list of columns: what each column is called, which member it shows, in
// which unit. Columns stand in the order of the list, the unit in the header with a prefix that suits all rows, a value
// with its uncertainty after GUM, a verdict as shape and word. No key of a record is ever shown.
//
// Thread-safety: the GUI thread; the texts are pure functions.
#pragma once

#include <QStringList>
#include <QTableWidget>
#include <nlohmann/json.hpp>
#include <vector>

namespace tacto::gui {

struct RecordColumn {
    enum class As { Text, Number, Spread, Tolerance, Share, Used, YesNo, Verdict, Load, LimitSet };
    QString title;
    std::string at;  ///< the member; "a.b" for a member of a member
    As as = As::Text;
    QString unit{};             ///< of a number; "@b": the record's own, which its member b states
    std::string uncertainty{};  ///< the member with U (95 %), in the number's unit; empty for none
};

/// The member at "a.b"; null where there is none.
[[nodiscard]] const nlohmann::json& memberAt(const nlohmann::json& record, const std::string& path);

/// A column as it is written: the header with its unit, a cell for each record, "–" for what is missing. A tolerance
/// has two digits at most, for more are not known, and its unit in the cell. A spread (a standard deviation, a
/// deviation without its U) is a number of two digits; of a tolerance or a limit the share used is "32 %". A statistic
/// {"mean","sd"} is "40.12 ± 0.46", an estimate {"value","low","high"} "1.50 (1.20 to 1.80)". A verdict may be given as
/// true or false. All have the prefix of the largest; numbers more than ten thousand times apart (a
/// thousand, where each has its uncertainty) carry one each, in their cells.
struct ColumnText {
    QString header;
    QStringList cells;
    bool right = false;
};
[[nodiscard]] ColumnText columnText(const RecordColumn& column, const nlohmann::json& records);

/// Nothing to edit, no scroll bars of its own: all rows are in sight, and the last column of words takes the room that
/// is left and elides. Takes `parent`.
[[nodiscard]] QTableWidget* makeRecordTable(const std::vector<RecordColumn>& columns, const nlohmann::json& records,
                                            QWidget* parent);
/// Headers and cells of a table that scrolls in its own place and has other rows now.
void fillRecordTable(QTableWidget& table, const std::vector<RecordColumn>& columns, const nlohmann::json& records);
/// Makes header, rows and columns of such a table as large as what is in them, in the current size of text.
void fitRecordTable(QTableWidget& table);
/// The same room for a table that is filled by hand, with putText(). `room_px`: no more than it has where it stands.
void layOutRecordTable(QTableWidget& table, int room_px = QWIDGETSIZE_MAX);
void putText(QTableWidget& table, int row, int column, const QString& text, bool right);

}  // namespace tacto::gui
