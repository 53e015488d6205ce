#include "app/report/TableContent.h"

#include <QJsonDocument>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "app/report/VerdictMark.h"
#include "core/base/JsonText.h"

namespace tacto {
namespace {

const QString kVerdict = QStringLiteral("verdict");

QStringList keysOf(const ReportTable& table) {
    if (!table.columns.isEmpty()) return table.columns;
    QStringList keys;
    for (const auto& row : table.rows) {
        const auto object = row.toObject();
        for (const auto& key : object.keys()) {
            if (!keys.contains(key)) keys << key;
        }
    }
    // QJsonObject does not keep its order, so keys that name a row are put first.
    static const QStringList first{"name", "condition", "load", "quantity", "subject", "a", "b", "n"};
    std::stable_sort(keys.begin(), keys.end(), [](const QString& left, const QString& right) {
        const auto rank = [](const QString& key) {
            const auto index = first.indexOf(key);
            return index < 0 ? first.size() : index;
        };
        return rank(left) < rank(right);
    });
    return keys;
}

/// Returns the columns of a script's table in their order, but with the verdict first, as in the window's tables.
QStringList columnsOf(const ReportTable& table) {
    QStringList keys = keysOf(table);
    if (const auto at = keys.indexOf(kVerdict); at > 0) keys.move(at, 0);
    return keys;
}

/// True if each row has its own unit: then the unit and the uncertainty are shown with the value.
bool hasUnitOfItsOwn(const QStringList& keys) { return keys.contains("unit") && keys.contains("value"); }

double numberOf(const QJsonObject& row, const char* key) { return row.value(QLatin1String(key)).toDouble(kUnknown); }

QString withOwnUnit(const QJsonObject& row, const QString& key) {
    const QString unit = row.value("unit").toString();
    if (key != "value") return settingText(row.value(key).toDouble(kUnknown), unit);
    const double value = numberOf(row, "value");
    return row.contains("expanded_uncertainty") ? uncertainText(value, numberOf(row, "expanded_uncertainty"), unit)
                                                : quantityText(value, unit);
}

/// Keeps a number on one line with its unit.
QString wordsOf(const QJsonValue& value, const QString& unit) {
    static const QRegularExpression kBeforeUnit("(?<=\\d) (?=(?:%|[nµmkM]?(?:V|A|s|Ω|C|J|W|N|Hz|Pa)\\b))",
                                                QRegularExpression::UseUnicodePropertiesOption);
    return withSigns(shownText(cellText(value, unit), kShownCell)).replace(kBeforeUnit, QString(QChar(0x202f)));
}

void fillColumn(TableBlock& table, const ReportTable& source, const QString& key) {
    const ColumnName name = columnName(key);
    const bool ownUnit = hasUnitOfItsOwn(keysOf(source)) && (key == "value" || key == "limit");
    std::vector<double> numbers;
    bool numeric = ownUnit;
    bool figures = key != "load" && !source.rows.isEmpty();  // texts that contain only numbers also count as numbers
    for (const auto& row : source.rows) {
        const auto value = row.toObject().value(key);
        if (value.isDouble()) numbers.push_back(value.toDouble());
        numeric = numeric || value.isDouble() || value.isObject();
        figures = figures && value.isString() && isFigure(value.toString());
    }
    const auto format = columnFormat(numbers, name.unit);
    QStringList cells;
    for (qsizetype r = 0; r < source.rows.size(); ++r) {
        const auto row = source.rows[r].toObject();
        const auto value = row.value(key);
        cells << (ownUnit                      ? withOwnUnit(row, key)
                  : value.isDouble() && format ? quantityText(value.toDouble(), name.unit, *format)
                  : key == kVerdict            ? verdictCell(shownText(cellText(value, {}), kShownCell))
                  : key == "load"              ? shownText(loadText(cellText(value, {})), kShownCell)
                                               : wordsOf(value, name.unit));
    }
    // The subject of a row begins with a capital; the name of a condition or material does not change.
    static const QStringList about{"requirement", "output", "trip"};
    if (about.contains(key)) std::ranges::transform(cells, cells.begin(), capitalised);
    if (key != "load") sharePrefix(cells);  // the name of a load stays as on the bench
    // Omits a column that is empty in every row.
    if (std::all_of(cells.begin(), cells.end(), [](const QString& cell) { return cell.isEmpty(); })) return;
    QString title = shownText(name.title, kShownCell);
    if (numeric || figures) {
        if (const QString unit = takeUnit(cells); !unit.isEmpty()) title += " (" + unit + ")";
        alignPoints(cells);
    }
    table.columns.push_back({title, numeric || figures});
    for (qsizetype r = 0; r < cells.size(); ++r) table.rows[static_cast<std::size_t>(r)] << cells[r];
}

}  // namespace

TableBlock tableOf(const ReportTable& source, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    const QStringList keys = columnsOf(source);
    table.rows.assign(static_cast<std::size_t>(source.rows.size()), QStringList());
    const bool merges = hasUnitOfItsOwn(keys);
    for (const auto& key : keys) {
        if (merges && (key == "unit" || key == "expanded_uncertainty")) continue;
        fillColumn(table, source, key);
        if (key == kVerdict) table.naming = table.columns.size();
    }
    return table;
}

MatrixBlock shortened(MatrixBlock matrix, const QString& caption) {
    matrix.caption = caption;
    const auto cut = [](QString& text) { text = shownText(text, kShownCell); };
    std::ranges::for_each(matrix.columns, cut);
    for (auto& row : matrix.rows) {
        cut(row.title);
        cut(row.note);
        for (auto& cell : row.cells) cut(cell.main);
    }
    return matrix;
}

MatrixBlock matrixOf(const ReportMatrix& source, const QString& caption) {
    const auto rows = parseJson(QJsonDocument(source.rows).toJson().toStdString(), "a matrix");
    return shortened(matrixOf(source.columns, rows.value_or(nlohmann::json::array())), caption);
}

TableBlock closestOf(const MatrixBlock& limits, const QString& caption) {
    constexpr std::size_t kCritical = 3;
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Verdict"}, {"Requirement"}, {"Load"}, {"Value", true}, {"Limit"}, {"Used", true}, {"Remark"}};
    table.naming = 1;
    for (const auto& row : limits.rows) {
        if (table.rows.size() == kCritical) break;
        if (row.worst < 0) continue;
        const auto& cell = row.cells[static_cast<std::size_t>(row.worst)];
        table.rows.push_back({verdictCell(cell.verdict), row.name, limits.columns[row.worst], cell.measured, row.limit,
                              cell.share, withSigns(cell.note)});
    }
    return table;
}

void sharePrefixes(std::vector<ReportBlock>& blocks) {
    for (auto& block : blocks) {
        auto* table = std::get_if<TableBlock>(&block);
        for (qsizetype c = 0; table != nullptr && c < qsizetype(table->columns.size()); ++c) {
            std::vector<QString*> cells;
            for (auto& row : table->rows)
                if (c < row.size()) cells.push_back(&row[c]);
            sharePrefix(cells);
        }
    }
}

TableBlock eventsTable(const ReportModel& model, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Time", true}, {"What"}, {"Details"}};
    for (const auto& event : model.events) {
        QString text = event.text.isEmpty() ? QString("–") : withSigns(event.text);
        if (event.count > 1) text += QString(" (%1 times)").arg(event.count);
        table.rows.push_back({QString::number(event.t_s, 'f', 3) + QChar(0x202f) + "s", event.kind, text});
    }
    return table;
}

}  // namespace tacto
