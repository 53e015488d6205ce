#include "app/report/TableContent.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "app/report/VerdictMark.h"

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
    // QJsonObject forgets the order: what names a row comes first.
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

/// Columns of a script's table in their order, but the verdict before all others, as in the window's tables.
QStringList columnsOf(const ReportTable& table) {
    QStringList keys = keysOf(table);
    if (const auto at = keys.indexOf(kVerdict); at > 0) keys.move(at, 0);
    return keys;
}

/// Rows that each carry their own unit show it with the value, and the uncertainty there too.
bool hasUnitOfItsOwn(const QStringList& keys) { return keys.contains("unit") && keys.contains("value"); }

double numberOf(const QJsonObject& row, const char* key) { return row.value(QLatin1String(key)).toDouble(kUnknown); }

QString withOwnUnit(const QJsonObject& row, const QString& key) {
    const QString unit = row.value("unit").toString();
    if (key != "value") return settingText(row.value(key).toDouble(kUnknown), unit);
    const double value = numberOf(row, "value");
    return row.contains("expanded_uncertainty") ? uncertainText(value, numberOf(row, "expanded_uncertainty"), unit)
                                                : quantityText(value, unit);
}

/// A number stays on its line with its unit.
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
    bool figures = key != "load" && !source.rows.isEmpty();  // texts of numbers are numbers too
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
    // What a row is about begins as a sentence does; a condition's or a material's name stays as it is given.
    static const QStringList about{"requirement", "output", "trip"};
    if (about.contains(key)) std::ranges::transform(cells, cells.begin(), capitalised);
    if (key != "load") sharePrefix(cells);  // a load's name stays as it is on the bench
    // A column of which no row says anything is not there.
    if (std::all_of(cells.begin(), cells.end(), [](const QString& cell) { return cell.isEmpty(); })) return;
    QString title = shownText(name.title, kShownCell);
    if (numeric || figures) {
        if (const QString unit = takeUnit(cells); !unit.isEmpty()) title += " (" + unit + ")";
        alignPoints(cells);
    }
    table.columns.push_back({title, numeric || figures});
    for (qsizetype r = 0; r < cells.size(); ++r) table.rows[static_cast<std::size_t>(r)] << cells[r];
}

/// How much of a limit used is worth a second look, %.
constexpr double kClose_pct = 80;

MatrixBlock::Cell judgedCell(const QJsonObject& cell, const QString& unit) {
    using State = MatrixBlock::State;
    const double used = 100 - numberOf(cell, "margin_pct");
    const QString verdict = cell.value("verdict").toString();
    const double value = numberOf(cell, "value"), expanded = numberOf(cell, "expanded_uncertainty");
    const bool timed = std::isfinite(used) && !std::isfinite(expanded);  // how soon the output ended, at most
    const QString measured = timed ? "≤ " + quantityText(value, unit, 2) : uncertainText(value, expanded, unit);
    if (verdict == "not evaluated") return {"–", "not evaluated", State::Open};
    if (verdict == "not applicable") return {"–", measured + "\nnot judged", State::Plain};
    if (!std::isfinite(used)) {  // no limit to be within: it happened or it did not
        return {verdictMark(verdict).shape, quantityText(numberOf(cell, "value"), unit),
                verdict == "fail" ? State::Broken : State::Plain};
    }
    const QString share = limitShareText(used);
    const auto marked = [&](const char* key) { return verdictMark(QString(key)).shape + " " + share; };
    if (verdict == "fail") return {marked("fail"), measured, State::Broken};
    if (verdict == "indeterminate") return {marked("indeterminate"), measured, State::Close};
    if (verdict == "attention") return {marked("attention"), measured, State::Close};
    return {share, measured, used >= kClose_pct ? State::Close : State::Plain};
}

MatrixBlock::Cell cellOf(const QJsonValue& value, const QString& rowUnit) {
    using State = MatrixBlock::State;
    if (!value.isObject()) return {};
    const auto cell = value.toObject();
    if (cell.contains("text"))
        return {verdictCell(shownText(cell.value("text").toString(), kShownCell)), {}, State::Plain};
    const QString unit = cell.value("unit").toString(rowUnit);
    if (cell.contains("margin_pct")) return judgedCell(cell, unit);
    const double measured = numberOf(cell, "value");
    if (!std::isfinite(measured)) return {"–", {}, State::Plain};
    if (!cell.contains("expanded_uncertainty")) return {quantityText(measured, unit), {}, State::Plain};
    const double expanded = numberOf(cell, "expanded_uncertainty");
    if (!std::isfinite(expanded)) return {quantityText(measured, unit), "U unknown", State::Plain};
    const QString text = uncertainText(measured, expanded, unit);
    const auto at = text.indexOf(" ± ");
    if (at < 0) return {text, {}, State::Plain};
    return {text.left(at), text.mid(at + 1), State::Plain};
}

/// One prefix for each unit of a matrix, whose columns are columns and whose rows are compared; the unit that all of a
/// row share stands in its title. What stands in two lines of a cell is one figure.
void shareUnits(std::vector<MatrixBlock::Row>& rows) {
    const auto isOne = [](const MatrixBlock::Cell& cell) { return cell.detail.startsWith("± "); };
    std::vector<QStringList> figures;
    std::vector<QString*> all;
    for (const auto& row : rows) {
        figures.emplace_back();
        for (const auto& cell : row.cells)
            figures.back() << (isOne(cell)             ? cell.main + ' ' + cell.detail
                               : cell.detail.isEmpty() ? cell.main
                                                       : cell.detail);
    }
    for (auto& row : figures)
        for (auto& figure : row) all.push_back(&figure);
    sharePrefix(all);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (const auto unit = takeUnit(figures[r]); !unit.isEmpty()) rows[r].title += " (" + unit + ")";
        for (std::size_t c = 0; c < rows[r].cells.size(); ++c) {
            auto& cell = rows[r].cells[c];
            const auto& figure = figures[r][static_cast<qsizetype>(c)];
            const auto at = figure.indexOf(" ± ");
            if (isOne(cell)) cell.main = figure.left(at);
            (isOne(cell)             ? cell.detail
             : cell.detail.isEmpty() ? cell.main
                                     : cell.detail) = isOne(cell) ? figure.mid(at + 1) : figure;
        }
    }
}

QString noteOf(const QJsonObject& row) {
    QStringList parts;
    if (row.value("limit").isDouble()) {
        parts << QString(row.value("compare").toString() == "<" ? "< " : "≤ ") +
                     settingText(numberOf(row, "limit"), row.value("unit").toString());
    }
    if (row.contains("set")) parts << limitSetTitle(row.value("set").toString());
    if (row.contains("sets")) {
        QStringList titles;
        for (const auto& set : row.value("sets").toArray()) titles << limitSetTitle(set.toString());
        parts << titles.join(", ");
    }
    if (row.contains("note")) parts << row.value("note").toString();
    return shownText(parts.join(" · "), kShownCell);
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

MatrixBlock matrixOf(const ReportMatrix& source, const QString& caption) {
    MatrixBlock matrix;
    matrix.caption = caption;
    bool judged = false;
    for (const auto& column : source.columns) matrix.columns << shownText(loadText(column), kShownCell);
    for (const auto& element : source.rows) {
        const auto object = element.toObject();
        MatrixBlock::Row row{capitalised(shownText(object.value("title").toString(), kShownCell)), noteOf(object), {}};
        for (const auto& cell : object.value("cells").toArray()) {
            judged = judged || cell.toObject().contains("margin_pct");
            row.cells.push_back(cellOf(cell, object.value("unit").toString()));
        }
        row.cells.resize(static_cast<std::size_t>(matrix.columns.size()));
        matrix.rows.push_back(std::move(row));
    }
    shareUnits(matrix.rows);
    if (judged) {
        matrix.legend =
            "Each cell: the share of the limit used, (value + U) / limit, and below it the value ± U (95\u202f%); what "
            "was "
            "commanded stands without a U. ✖ "
            "exceeded, ? indeterminate, ▲ above a figure that asks for attention; shaded: 80\u202f% or more used, "
            "hatched: not evaluated. Rows of which the most is used come first.";
    }
    return matrix;
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
