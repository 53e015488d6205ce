#include "app/gui/theme/RecordColumns.h"

#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

using nlohmann::json;

constexpr int kHeaderPad = 10, kRow = 30;
constexpr int kLongestText = 44;  // most characters of a text column that is not the last
constexpr int kMinText = 10;      // least characters of a text column if numbers need the room
constexpr int kMinTextTight = 6;  // the same in a table narrower than a small window
constexpr int kRoom = 860;        // pixels of a table in a window of 1280; a wider table gets small text

/// Sets the header's height for its longest title.
void fitHeader(QTableWidget& table) {
    auto* header = table.horizontalHeader();
    setTextSize(*header, TextSize::Small);
    int lines = 1;
    for (int c = 0; c < table.columnCount(); ++c) {
        const auto* item = table.horizontalHeaderItem(c);  // null: the column has no title
        if (item != nullptr) lines = std::max(lines, int(item->text().count('\n')) + 1);
    }
    header->setFixedHeight(lines * QFontMetrics(textFont(TextSize::Small)).height() + kHeaderPad);
}

bool isOfNumbers(const QTableWidget& table, int column) {
    for (int row = 0; row < table.rowCount(); ++row) {
        const auto* item = table.item(row, column);
        if (item != nullptr && (item->textAlignment() & Qt::AlignRight) != 0) return true;
    }
    return false;
}

/// Fits the columns to their content (text columns up to a limit) and returns the width of the table.
int fitColumns(QTableWidget& table) {
    const int longest = table.fontMetrics().averageCharWidth() * kLongestText;
    table.resizeColumnsToContents();
    int width = 2 * table.frameWidth();
    for (int c = 0; c < table.columnCount(); ++c) {
        if (table.columnWidth(c) > longest && !isOfNumbers(table, c)) table.setColumnWidth(c, longest);
        width += table.columnWidth(c);
    }
    return width;
}

/// Narrows text columns, the widest first, until the table fits: numbers are never cut off. The last column takes the
/// rest by itself. Returns the table's width.
int narrowWords(QTableWidget& table, int width, int room) {
    const bool tight = room < scaledPx(kRoom);
    const int least = table.fontMetrics().averageCharWidth() * (tight ? kMinTextTight : kMinText);
    while (width > room) {
        int widest = -1;
        for (int c = 0; c < table.columnCount(); ++c) {
            if (table.columnWidth(c) <= least || isOfNumbers(table, c)) continue;
            if (widest < 0 || table.columnWidth(c) > table.columnWidth(widest)) widest = c;
        }
        if (widest < 0) return width;
        const int narrower = std::max(least, table.columnWidth(widest) - std::min(least, width - room));
        width -= table.columnWidth(widest) - narrower;
        table.setColumnWidth(widest, narrower);
    }
    return width;
}

/// Makes all rows visible. If the numbers do not fit, the table scrolls sideways, with its bar below the last row.
void keepWhole(QTableWidget& table, int height) {
    constexpr const char* kHeight = "heightOfRows";
    auto& bar = *table.horizontalScrollBar();
    const auto fit = [&table, &bar] {
        const int below = bar.maximum() > bar.minimum() ? bar.sizeHint().height() : 0;
        table.setFixedHeight(table.property(kHeight).toInt() + below);
    };
    const bool first = !table.property(kHeight).isValid();
    table.setProperty(kHeight, height);
    if (first) QObject::connect(&bar, &QScrollBar::rangeChanged, &table, fit);
    fit();
}

/// Breaks a title into two lines if it is longer than its column's numbers.
QString inLines(const QString& header) {
    constexpr qsizetype kLine = 14;
    const auto end = header.indexOf('\n') < 0 ? header.size() : header.indexOf('\n');
    if (end <= kLine) return header;
    qsizetype best = -1;
    for (auto at = header.indexOf(' '); at >= 0 && at < end; at = header.indexOf(' ', at + 1))
        if (best < 0 || std::abs(2 * at - end) < std::abs(2 * best - end)) best = at;
    return best < 0 ? header : header.left(best) + '\n' + header.mid(best + 1);
}

}  // namespace

void fillRecordTable(QTableWidget& table, const std::vector<ResultColumn>& columns, const json& records) {
    table.clear();
    table.setColumnCount(int(columns.size()));
    table.setRowCount(int(records.size()));
    const auto texts = columnTexts(columns, records);
    for (int c = 0; c < int(columns.size()); ++c) {
        const auto& text = texts[std::size_t(c)];
        auto* header = new QTableWidgetItem(text.right ? inLines(text.header) : text.header);
        header->setTextAlignment((text.right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
        table.setHorizontalHeaderItem(c, header);
        for (int r = 0; r < table.rowCount(); ++r) {
            putText(table, r, c, text.cells[r], text.right);
            if (!text.right) table.item(r, c)->setToolTip(text.cells[r]);
        }
    }
    fitHeader(table);
}

void fitRecordTable(QTableWidget& table) {
    fitHeader(table);
    table.verticalHeader()->setDefaultSectionSize(scaledPx(kRow));
    table.resizeColumnsToContents();
}

QTableWidget* makeRecordTable(const std::vector<ResultColumn>& columns, const json& records, QWidget* parent) {
    auto* table = new QTableWidget(parent);
    fillRecordTable(*table, columns, records);
    layOutRecordTable(*table);
    return table;
}

void putText(QTableWidget& table, int row, int column, const QString& text, bool right) {
    auto* item = new QTableWidgetItem(text);
    item->setTextAlignment((right ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    table.setItem(row, column, item);
}

void layOutRecordTable(QTableWidget& table, int room_px) {
    makeReadOnly(table);
    table.setWordWrap(false);
    table.setTextElideMode(Qt::ElideRight);
    table.setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    auto* header = table.horizontalHeader();
    header->setHighlightSections(false);
    header->setSectionsClickable(false);
    fitHeader(table);
    header->setStretchLastSection(false);  // otherwise a new layout would give it the width of its content
    int width = fitColumns(table);
    if (width > std::min(kRoom, room_px)) {
        setTextSize(table, TextSize::Small);
        const int room = std::min(scaledPx(kRoom), room_px);
        width = narrowWords(table, fitColumns(table), room);
        if (width > room) width = fitColumns(table);  // it scrolls anyway, so text columns are not narrowed
    }
    // A last column of text takes the rest; a column of numbers stays next to the others.
    const bool words = !isOfNumbers(table, table.columnCount() - 1);
    header->setStretchLastSection(words);
    table.setMaximumWidth(words ? QWIDGETSIZE_MAX : width);
    table.resizeRowsToContents();
    int height = header->height() + 2 * table.frameWidth();
    for (int row = 0; row < table.rowCount(); ++row) height += table.rowHeight(row);
    keepWhole(table, height);
}

}  // namespace tacto::gui
