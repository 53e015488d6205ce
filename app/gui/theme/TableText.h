// TableText.h - every table leaves the window: Ctrl+A and Ctrl+C copy it as tab-separated text, and its context menu
// also saves it as CSV.
//
// Both texts are quoted as RFC 4180 says, so that spreadsheets and csv readers get tabs, quotes and line breaks back.
// Units stand in the headings: a column whose cells have one unit, or prefixes of one, has the plain numbers. Columns
// that are hidden for lack of room are copied and saved too.
#pragma once

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
/// One line for each row, each ended by a line break; the headings first. `separator`: a tab or a comma.
[[nodiscard]] QString separated(const TableText& table, QChar separator);

/// Serves all tables of the program, each of which lets a person select cells or rows; calendars are left alone.
class TableCopies final : public QObject {
    Q_OBJECT
public:
    /// A second call does nothing.
    static void install();
    /// Copies what is selected, or all if nothing is; one cell alone is copied without its heading.
    static void copy(const QTableView& table);
    /// Asks for a file, and saves the table as it was when asked.
    static void askSave(QTableView& table);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    using QObject::QObject;
};

}  // namespace tacto::gui
