#include "app/report/MatrixBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "app/report/NumberText.h"
#include "app/report/ResultCells.h"
#include "core/base/JsonText.h"

namespace tacto {
namespace {

using nlohmann::json;
using State = MatrixBlock::State;

/// Share of a limit, in %, from which it deserves attention.
constexpr double kClose_pct = 80;

QString wordsIn(const json& of, const char* key) { return visible(QString::fromStdString(textOr(of, key))); }

QString withCapital(QString text) { return text.replace(0, 1, text.left(1).toUpper()); }

void judge(MatrixBlock::Cell& out, const json& cell, const QString& unit, bool hasLimit) {
    const double used = 100 - numberOr(cell, "margin_pct");
    const double value = numberOr(cell, "value"), expanded = numberOr(cell, "expanded_uncertainty");
    const bool known = std::isfinite(used);
    const bool timed = known && !std::isfinite(expanded);  // the value is an upper bound: how soon the output ended
    const auto mark = verdictShape(out.verdict);
    out.measured = timed ? "≤ " + quantityText(value, unit, 2) : uncertainText(value, expanded, unit);
    out.state = State::Plain;
    out.main = "–";
    out.hasShare = known;
    out.isNear = used >= kClose_pct;
    if (out.verdict == "not evaluated") {
        out.detail = out.verdict;
        out.state = State::Open;
        out.share = "n.\u00a0e.";
    } else if (out.verdict == "not applicable") {
        out.detail = out.measured + "\nnot judged";
        out.share = "–";
    } else if (!known && !hasLimit) {  // a rule without a limit: kept or not kept
        const bool failed = out.verdict == "fail";
        out.main = mark;
        out.detail = out.measured = quantityText(value, unit);
        out.state = failed ? State::Broken : State::Plain;
        out.share = std::isfinite(value) ? quantityText(value, unit, 3) : failed ? "no" : "–";
    } else {
        const bool stands = out.verdict == "fail" || out.verdict == "indeterminate" || out.verdict == "attention";
        out.share = limitShareText(used);
        out.main = stands ? mark + " " + out.share : known ? out.share : mark;
        out.detail = known ? out.measured : quantityText(value, unit);
        out.state = out.verdict == "fail" ? State::Broken : stands || out.isNear ? State::Close : State::Plain;
    }
}

/// Puts a figure into a cell, with its expanded uncertainty below.
void putFigure(MatrixBlock::Cell& out, const QString& text) {
    const auto at = text.indexOf(" ± ");
    out.main = at < 0 ? text : text.left(at);
    out.detail = at < 0 ? QString() : text.mid(at + 1);
    out.state = State::Plain;
}

MatrixBlock::Cell cellOf(const json& cell, const QString& rowUnit, bool hasLimit) {
    MatrixBlock::Cell out;
    if (!cell.is_object()) return out;
    out.verdict = wordsIn(cell, "verdict");
    out.note = wordsIn(cell, "note");
    const auto unit = cell.contains("unit") ? wordsIn(cell, "unit") : rowUnit;
    const double value = numberOr(cell, "value"), expanded = numberOr(cell, "expanded_uncertainty");
    if (cell.contains("text"))
        putFigure(out, verdictCell(wordsIn(cell, "text")));
    else if (cell.contains("margin_pct"))
        judge(out, cell, unit, hasLimit);
    else if (!std::isfinite(value) || !cell.contains("expanded_uncertainty"))
        putFigure(out, quantityText(value, unit));
    else if (std::isfinite(expanded))
        putFigure(out, uncertainText(value, expanded, unit));
    else
        out.main = quantityText(value, unit), out.detail = "U unknown", out.state = State::Plain;
    return out;
}

/// Uses one prefix per unit in the whole matrix, because rows are compared too; a unit that a whole row shares moves to
/// its title. Two lines of a cell are one figure.
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
            if (isOne(cell))
                putFigure(cell, figure);
            else
                (cell.detail.isEmpty() ? cell.main : cell.detail) = figure;
        }
    }
}

MatrixBlock::Row rowOf(const json& line) {
    MatrixBlock::Row row;
    row.title = row.name = withCapital(wordsIn(line, "title"));
    row.unit = wordsIn(line, "unit");
    row.source = wordsIn(line, "source");
    row.verdict = wordsIn(line, "verdict");
    row.limit = limitText(line);
    row.hasLimit = !row.limit.isEmpty();
    QStringList sets;
    for (const auto& set : line.contains("sets") ? sentencesIn(line.at("sets")) : QStringList(wordsIn(line, "set")))
        if (!set.isEmpty()) sets << limitSetTitle(set);
    row.set = sets.join(", ");
    QStringList note{row.limit, row.set, wordsIn(line, "note")};
    note.removeAll(QString());
    row.note = note.join(" · ");
    const auto worst = textOr(line, "worst_load");
    for (const auto& cell : memberAt(line, "cells")) {
        if (cell.is_object() && !worst.empty() && textOr(cell, "load") == worst) row.worst = int(row.cells.size());
        row.cells.push_back(cellOf(cell, row.unit, row.hasLimit));
    }
    return row;
}

/// True for the same limit in two documents; the table of sources lists both.
bool isSameLimit(const json& a, const json& b) {
    const auto values = [](const json& line) {
        json out = json::array();
        for (const auto& cell : memberAt(line, "cells"))
            out.push_back(json{memberAt(cell, "value"), memberAt(cell, "verdict")});
        return out;
    };
    return std::ranges::all_of(std::array{"title", "limit", "unit"},
                               [&](const char* key) { return memberAt(a, key) == memberAt(b, key); }) &&
           values(a) == values(b);
}

}  // namespace

MatrixBlock matrixOf(const QStringList& columns, const json& rows) {
    MatrixBlock matrix;
    bool judged = false;
    for (const auto& column : columns) matrix.columns << loadText(visible(column));
    for (const auto& line : rows) {
        auto& row = matrix.rows.emplace_back(rowOf(line.is_object() ? line : json::object()));
        row.cells.resize(static_cast<std::size_t>(columns.size()));
        if (row.worst >= columns.size()) row.worst = -1;
        for (const auto& cell : memberAt(line, "cells")) judged = judged || cell.contains("margin_pct");
    }
    shareUnits(matrix.rows);
    if (judged) {
        matrix.legend =
            "Each cell: the share of the limit used, (value + U) / limit, and below it the value ± U (95\u202f%); what "
            "was commanded stands without a U. ✖ exceeded, ? indeterminate, ▲ above a figure that asks for attention; "
            "shaded: 80\u202f% or more used, hatched: not evaluated. Rows of which the most is used come first.";
    }
    return matrix;
}

MatrixBlock limitsOf(const json& matrix) {
    json rows = json::array();
    const auto &lines = memberAt(matrix, "lines"), &loads = memberAt(matrix, "loads");
    if (!lines.is_array() || !loads.is_array()) return {};
    QStringList columns;
    for (const auto& load : loads) {
        if (!load.is_string()) return {};
        columns << QString::fromStdString(load.get<std::string>());
    }
    for (const auto& line : lines) {
        if (!line.is_object()) continue;
        auto same = std::ranges::find_if(rows, [&](const json& row) { return isSameLimit(row, line); });
        if (same == rows.end()) {
            rows.push_back(line);
            same = std::prev(rows.end());
            (*same)["sets"] = json::array();
        }
        (*same)["sets"].push_back(memberAt(line, "set"));
        if (textOr(line, "compare") == "<") (*same)["compare"] = "<";
    }
    auto block = matrixOf(columns, rows);
    for (auto& row : block.rows) {
        if (row.hasLimit) continue;
        row.limit = row.note = kUntilNextTrain;
    }
    return block;
}

MatrixBlock acrossOf(const ResultTable& table, const json& all) {
    json records = json::array();
    const auto isMeasured = [&](const json& record) {
        return std::ranges::any_of(table.columns, [&](const ResultColumn& column) {
            return !column.beside.empty() && memberAt(record, column.at).is_number();
        });
    };
    std::ranges::copy_if(all, std::back_inserter(records), isMeasured);
    MatrixBlock matrix;
    for (const auto& column : table.columns) {
        const auto text = columnText(column, records);
        if (matrix.columns.isEmpty()) {
            matrix.columns = text.cells;
            continue;
        }
        MatrixBlock::Row row;
        row.title = QString(text.header).replace('\n', ' ');
        for (const auto& cell : text.cells) putFigure(row.cells.emplace_back(), cell);
        matrix.rows.push_back(std::move(row));
    }
    return matrix;
}

}  // namespace tacto
