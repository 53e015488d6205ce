// TableText.h - every table leaves the window: Ctrl+A and Ctrl+C copy it as tab-separated text, and its context menu
// also saves it as CSV.
//
// Both texts are quoted as RFC 4180 says, so that spreadsheets and csv readers get tabs, quotes and line breaks back.
// Units stand in the headings: a column whose cells have one unit, or prefixes of one, has the plain numbers. Columns
// that are hidden for lack of room are copied and saved too. A form of facts is copied as a table with a row for each,
// whose name states the unit. A text that a spreadsheet would calculate is written with an apostrophe before it.
#pragma once

#include <QFormLayout>
#include <QItemSelectionModel>
#include <QObject>
#include <QStringList>
#include <QTableView>
#include <vector>

namespace tacto::gui {

/// The role of a text that is copied in place of the cell's or heading's own, for one that its delegate draws in parts.
inline constexpr int kCopiedTextRole = Qt::UserRole + 100;

/// A table as text; each row has as many cells as there are headings.
struct TableText {
    QStringList head;
    std::vector<QStringList> rows;
};
/// Returns the whole table, or the rows and columns with a selected cell; other cells of these are then empty.
[[nodiscard]] TableText textOf(const QTableView& table, const QItemSelection* only = nullptr);
/// Returns a row for each fact of the form, whose rows have two labels.
[[nodiscard]] TableText textOf(const QFormLayout& facts);
/// Marks `holder`, the widget with such a form as its layout: it is copied and saved under its accessible name.
void copyAsTable(QWidget& holder);
/// One line for each row, each ended by a line break; the headings first. `separator`: a tab or a comma.
[[nodiscard]] QString separated(const TableText& table, QChar separator);
/// Returns the text with an apostrophe before it if it begins with = + - @, a tab or a line break and is no number: a
/// spreadsheet would take it for a formula.
[[nodiscard]] QString inertCell(const QString& cell);

/// Serves all tables of the program, each of which lets a person select cells or rows, and forms that copyAsTable()
/// marked; calendars are left alone.
class TableCopies final : public QObject {
    Q_OBJECT
public:
    /// A second call does nothing.
    static void install();
    /// Copies what is selected, or all if nothing is; one cell alone is copied without its heading.
    static void copy(const QTableView& table);
    /// Asks for a file, and saves the table as it was when asked. `asking`: the widget that shows it.
    static void askSave(QWidget& asking, const TableText& table);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    using QObject::QObject;
};

}  // namespace tacto::gui
