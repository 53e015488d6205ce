#include "app/cli/Verdicts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/report/MatrixBlock.h"
#include "app/report/ResultCells.h"
#include "core/base/JsonText.h"
#include "core/kinds/ResultKinds.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

/// Returns the text on one line, with ordinary spaces.
std::string plain(QString text) {
    return text.replace('\n', ' ').replace(QChar(0x202f), ' ').replace(QChar(0x00a0), ' ').toStdString();
}

void printFacts(const ResultTable& table, const json& record) {
    TextTable lines({"", ""});
    bool any = false;
    for (const auto& column : table.columns) {
        if (memberAt(record, column.at).is_null()) continue;
        const auto text = columnText(column, json::array({record}));
        lines.add({plain(text.header), plain(text.cells.front())});
        any = true;
    }
    if (!any) return;
    say("\n  {}\n", table.title);
    lines.print();
}

void printRows(const ResultTable& table, const json& records) {
    std::vector<ColumnText> columns;
    std::vector<std::string> headings;
    for (const auto& column : table.columns) {
        auto text = columnText(column, records);
        if (std::ranges::all_of(text.cells, [](const QString& cell) { return cell == u"–"; })) continue;
        headings.push_back((text.right ? ">" : "") + plain(text.header));
        columns.push_back(std::move(text));
    }
    if (columns.empty()) return;
    TextTable lines(headings);
    for (qsizetype r = 0; r < qsizetype(records.size()); ++r) {
        std::vector<std::string> cells;
        for (const auto& column : columns) cells.push_back(plain(column.cells[r]));
        lines.add(std::move(cells));
    }
    say("\n  {}", table.title);
    lines.print();
    if (!table.note.empty()) say("  {}\n", table.note);
}

/// Prints counts with their row and column.
void printCounts(const ResultTable& table, const json& results) {
    const auto text = countsText(table, results);
    if (text.counts.empty()) return;
    std::vector<std::string> headings{"presented"};
    for (const auto& name : text.across) headings.push_back(">" + plain(name));
    TextTable lines(headings);
    for (std::size_t r = 0; r < text.counts.size(); ++r) {
        std::vector<std::string> cells{plain(text.down[qsizetype(r)])};
        for (const auto& count : text.counts[r]) cells.push_back(plain(count));
        lines.add(std::move(cells));
    }
    say("\n  {}", table.title);
    lines.print();
}

/// Prints the used share of each limit on each load.
void printLimits(const ResultTable& table, const MatrixBlock& limits) {
    if (limits.rows.empty()) return;
    std::vector<std::string> headings{"Limit", "At most"};
    for (const auto& column : limits.columns) headings.push_back(">" + plain(column));
    TextTable lines(headings);
    for (const auto& row : limits.rows) {
        std::vector<std::string> cells{plain(row.name), plain(row.note)};
        for (const auto& cell : row.cells)
            cells.push_back(cell.verdict.isEmpty() ? "" : plain(verdictShape(cell.verdict) + ' ' + cell.share));
        lines.add(std::move(cells));
    }
    say("\n  {}: share used, with U", table.title);
    lines.print();
}

}  // namespace

int exitForVerdict(std::string_view verdict) noexcept {
    if (verdict == "fail") return kVerdictFailed;
    if (verdict == "indeterminate") return kIndeterminate;
    if (verdict == "stopped") return kStopped;
    return kDone;
}

void printResults(const nlohmann::json& results) {
    TextTable table({"", ""});
    for (const auto& [key, value] : results.items()) {
        if (key != "verdict") table.add({key, value.is_string() ? value.get<std::string>() : dumpJson(value)});
    }
    say("\n");
    table.print();
}

void printTables(std::string_view kind, const json& results) {
    using Shape = ResultTable::Shape;
    for (const auto& table : resultTraits(kind).tables) {
        if (!isInTerminal(table.shown)) continue;
        const auto& value = table.at.empty() ? results : memberAt(results, table.at);
        if (table.shape == Shape::Rows)
            printRows(table, rowsOf(table, results));
        else if (table.shape == Shape::Facts && value.is_object())
            printFacts(table, value);
        else if (table.shape == Shape::Confusion)
            printCounts(table, results);
        else if (table.shape == Shape::Limits)
            printLimits(table, limitsOf(value));
        else if (table.shape == Shape::Sentences)
            for (const auto& sentence : sentencesIn(value)) say("  {}\n", plain(sentence));
    }
}

void printVerdict(std::string_view verdict, const std::vector<std::string>& reasons) {
    TextTable table({"", ""});
    table.add({"verdict", std::string(verdict)});
    for (const auto& reason : reasons) table.add({"", reason});
    table.print();
}

}  // namespace tacto::cli
