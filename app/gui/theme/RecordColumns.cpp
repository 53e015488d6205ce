#include "app/gui/theme/RecordColumns.h"

#include <QHeaderView>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/Verdict.h"
#include "app/report/NumberText.h"
#include "app/report/TableContent.h"
#include "core/base/JsonFields.h"

namespace tacto::gui {

namespace {

using nlohmann::json;
using As = RecordColumn::As;

constexpr double kOnePrefix = 1e4;        // numbers further apart than this have a prefix each
constexpr double kOnePrefixWithU = 1000;  // and those with all the decimals of an uncertainty
constexpr int kDigits = 4, kSpreadDigits = 2;
constexpr int kHeaderPad = 10, kRow = 30;
constexpr int kLongestText = 44;  // characters of a column of words that is not the last
constexpr int kMinText = 10;      // and where numbers need the room
constexpr int kMinTextTight = 6;  // and where the table stands in less than that of a small window
constexpr int kRoom = 860;        // pixels beside a path in a window of 1280: a wider table is set small
const QString kNone = QStringLiteral("–");

/// A number of a record with what is known around it.
struct Known {
    double value = std::nan("");
    double around = std::nan("");  ///< U, or a standard deviation
    double low = std::nan("");
    double high = std::nan("");
    bool hasAround = false;
};

QString textOf(const json& value) {
    if (value.is_string()) return visible(QString::fromStdString(value.get<std::string>()));
    if (value.is_boolean()) return value.get<bool>() ? QObject::tr("yes") : QObject::tr("no");
    if (value.is_number()) return settingText(value.get<double>(), {});
    return kNone;
}

Known knownOf(const RecordColumn& column, const json& record) {
    const auto& value = memberAt(record, column.at);
    Known known;
    known.value = numberOr(value);
    if (value.is_object()) {
        const bool spread = value.contains("mean") || value.contains("sd");
        known.value = numberOr(memberAt(value, value.contains("mean")     ? "mean"
                                               : value.contains("median") ? "median"
                                                                          : "value"));
        known.hasAround = spread;
        if (spread) known.around = numberOr(memberAt(value, "sd"));
        known.low = spread ? std::nan("") : numberOr(memberAt(value, "low"));
        known.high = spread ? std::nan("") : numberOr(memberAt(value, "high"));
    }
    if (!column.uncertainty.empty()) {
        known.hasAround = true;
        known.around = numberOr(memberAt(record, column.uncertainty));
    }
    return known;
}

/// The text of one number in `unit`; with `spread` the second one is a standard deviation, and may be unknown.
QString numberText(const Known& known, const QString& unit, bool isU, int digits = kDigits) {
    if (!std::isfinite(known.value)) return kNone;
    if (known.hasAround)
        return isU ? uncertainText(known.value, known.around, unit) : spreadText(known.value, known.around, unit);
    if (std::isfinite(known.low) && std::isfinite(known.high))
        return intervalText({known.value, known.low, known.high}, unit);
    return quantityText(known.value, unit, digits);
}

/// The unit below the title, also where it is the title's own word: "Smallest pair (JND)".
QString onTwoLines(QString title) {
    if (const auto at = title.lastIndexOf(" ("); at > 0 && title.endsWith(')')) title[at] = '\n';
    return title;
}

QString withUnit(const QString& title, const QString& unit) {
    return unit.isEmpty() ? title : QString("%1\n(%2)").arg(title, unit);
}

void scale(Known& known, double factor) {
    for (auto* number : {&known.value, &known.around, &known.low, &known.high}) *number *= factor;
}

ColumnText sharesText(const RecordColumn& column, const json& records) {
    ColumnText out{withUnit(column.title, "%"), {}, true};
    for (const auto& record : records) {
        auto known = knownOf(column, record);
        scale(known, 100);
        const auto tenth = [](double value) { return decimalText(value, 1); };
        out.cells << (std::isfinite(known.low) && std::isfinite(known.high)
                          ? QObject::tr("%1 (%2 to %3)").arg(tenth(known.value), tenth(known.low), tenth(known.high))
                          : numberText(known, {}, true));
    }
    return out;
}

ColumnText numbersText(const RecordColumn& column, const json& records) {
    ColumnText out{column.title, {}, true};
    const bool isU = !column.uncertainty.empty();
    const int digits = column.as == As::Spread ? kSpreadDigits : kDigits;
    std::vector<Known> all;
    std::vector<double> values;
    double least = 0, most = 0;
    for (const auto& record : records) {
        all.push_back(knownOf(column, record));
        values.push_back(all.back().value);
        const double size = std::abs(all.back().value);
        const double seen =
            all.back().hasAround && std::isfinite(all.back().around) ? std::max(size, all.back().around) : size;
        if (!std::isfinite(seen) || seen == 0) continue;
        least = least == 0 ? seen : std::min(least, seen);
        most = std::max(most, seen);
    }
    const bool own = column.unit.startsWith('@');
    const bool around =
        std::any_of(all.begin(), all.end(), [](const Known& k) { return k.hasAround || std::isfinite(k.low); });
    const bool apart = most > (around ? kOnePrefixWithU : kOnePrefix) * least;
    const auto axis = axisUnit(most, own ? QString() : column.unit);
    const auto format = columnFormat(values, column.unit);
    for (std::size_t row = 0; row < all.size(); ++row) {
        auto& known = all[row];
        if (own) {
            const auto unit = textOf(memberAt(records[row], column.unit.mid(1).toStdString()));
            out.cells << numberText(known, unit, isU, digits);
        } else if (apart && !column.unit.isEmpty()) {
            out.cells << numberText(known, column.unit, isU, digits);
        } else if (!around && digits == kDigits && format && std::isfinite(known.value)) {
            out.cells << quantityText(known.value, column.unit, *format).section(QChar(0x202f), 0, 0);
        } else {
            scale(known, axis.factor);
            out.cells << numberText(known, {}, isU, digits);
        }
    }
    for (auto& cell : out.cells) cell = grouped(std::move(cell));
    out.header = !own && !apart && !axis.unit.isEmpty() ? withUnit(column.title, axis.unit) : onTwoLines(column.title);
    return out;
}

ColumnText usedText(const RecordColumn& column, const json& records) {
    ColumnText out{column.title, {}, true};
    for (const auto& record : records) out.cells << limitShareText(100 * numberOr(memberAt(record, column.at)));
    return out;
}

ColumnText tolerancesText(const RecordColumn& column, const json& records) {
    ColumnText out{column.title, {}, true};
    for (const auto& record : records) {
        const auto& value = memberAt(record, column.at);
        out.cells << (value.is_number() ? toleranceText(value.get<double>(), column.unit) : kNone);
    }
    return out;
}

QString wordsText(As as, const json& value) {
    if (value.is_null()) return kNone;
    const auto text = textOf(value);
    switch (as) {
        case As::Verdict:
            if (value.is_boolean()) return verdictText(value.get<bool>() ? "pass" : "fail");
            return text.isEmpty() || text == kNone ? kNone : verdictText(text);
        case As::Load:
            return loadText(text);
        case As::LimitSet:
            return limitSetTitle(text);
        default:
            return text.isEmpty() ? kNone : withSigns(text);
    }
}

/// As many lines as the longest title has.
void fitHeader(QTableWidget& table) {
    auto* header = table.horizontalHeader();
    setTextSize(*header, TextSize::Small);
    int lines = 1;
    for (int c = 0; c < table.columnCount(); ++c) {
        const auto* item = table.horizontalHeaderItem(c);  // null: it has no title
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

/// The width of the table with columns as wide as what is in them, words up to their bound.
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

/// Takes what is missing from the columns of words, the widest first: a number is never cut. The last one takes the
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

/// All rows are in sight; where numbers have no room the table scrolls sideways, with its bar below the last row.
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

}  // namespace

const json& memberAt(const json& record, const std::string& path) {
    static const json kNothing;
    const auto* here = &record;
    for (std::size_t from = 0; from <= path.size() && !path.empty();) {
        const auto dot = std::min(path.find('.', from), path.size());
        if (!here->is_object()) return kNothing;
        const auto at = here->find(path.substr(from, dot - from));
        if (at == here->end()) return kNothing;
        here = &*at;
        from = dot + 1;
    }
    return *here;
}

ColumnText columnText(const RecordColumn& column, const json& records) {
    if (column.as == As::Share) return sharesText(column, records);
    if (column.as == As::Used) return usedText(column, records);
    if (column.as == As::Number || column.as == As::Spread) return numbersText(column, records);
    if (column.as == As::Tolerance) return tolerancesText(column, records);
    ColumnText out{column.title, {}, false};
    for (const auto& record : records) out.cells << wordsText(column.as, memberAt(record, column.at));
    return out;
}

void fillRecordTable(QTableWidget& table, const std::vector<RecordColumn>& columns, const json& records) {
    table.clear();
    table.setColumnCount(int(columns.size()));
    table.setRowCount(int(records.size()));
    for (int c = 0; c < int(columns.size()); ++c) {
        const auto& column = columns[std::size_t(c)];
        const auto text = columnText(column, records);
        auto* header = new QTableWidgetItem(text.header);
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

QTableWidget* makeRecordTable(const std::vector<RecordColumn>& columns, const json& records, QWidget* parent) {
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
    table.verticalHeader()->hide();
    table.setEditTriggers(QAbstractItemView::NoEditTriggers);
    table.setSelectionMode(QAbstractItemView::NoSelection);
    table.setWordWrap(false);
    table.setTextElideMode(Qt::ElideRight);
    table.setTabKeyNavigation(false);
    table.setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    auto* header = table.horizontalHeader();
    header->setHighlightSections(false);
    header->setSectionsClickable(false);
    fitHeader(table);
    header->setStretchLastSection(false);  // else it is as wide as what is in it when the table is laid out again
    int width = fitColumns(table);
    if (width > std::min(kRoom, room_px)) {
        setTextSize(table, TextSize::Small);
        const int room = std::min(scaledPx(kRoom), room_px);
        width = narrowWords(table, fitColumns(table), room);
        if (width > room) width = fitColumns(table);  // it scrolls: no word gives way for nothing
    }
    // A last column of words takes the rest; one of numbers stands beside the others.
    const bool words = !isOfNumbers(table, table.columnCount() - 1);
    header->setStretchLastSection(words);
    table.setMaximumWidth(words ? QWIDGETSIZE_MAX : width);
    table.resizeRowsToContents();
    int height = header->height() + 2 * table.frameWidth();
    for (int row = 0; row < table.rowCount(); ++row) height += table.rowHeight(row);
    keepWhole(table, height);
}

}  // namespace tacto::gui
