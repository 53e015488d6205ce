// The tables of results, as the terminal has them.
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "app/report/ResultCells.h"
#include "core/results/ResultKind.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

/// In one line, with the spaces of a keyboard.
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

/// Counts, row by column; the names are those of the conditions.
void printCounts(const ResultTable& table, const json& results) {
    const auto& counts = memberAt(results, table.at);
    const auto& conditions = memberAt(results, "conditions");
    if (!counts.is_array() || !conditions.is_array() || counts.size() != conditions.size()) return;
    auto across = sentencesIn(memberAt(results, "columns"));
    QStringList down;
    for (const auto& each : conditions) down << sentencesIn(memberAt(each, "name"));
    if (across.isEmpty()) across = down;
    std::vector<std::string> headings{"presented"};
    for (const auto& name : across) headings.push_back(">" + plain(name));
    TextTable lines(headings);
    for (std::size_t r = 0; r < counts.size() && qsizetype(r) < down.size(); ++r) {
        std::vector<std::string> cells{plain(down[qsizetype(r)])};
        for (const auto& count : counts[r]) cells.push_back(dumpJson(count));
        cells.resize(headings.size());
        lines.add(std::move(cells));
    }
    say("\n  {}", table.title);
    lines.print();
}

}  // namespace

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
        else if (table.shape == Shape::Sentences)
            for (const auto& sentence : sentencesIn(value)) say("  {}\n", plain(sentence));
    }
}

}  // namespace tacto::cli
