// ResultCells.h - results as text: the cells of a column, the same in window, report and terminal.
#pragma once

#include <QStringList>

#include "core/results/ResultTable.h"

namespace tacto {

/// A column as it is written: the header with its unit on a line of its own, a cell for each record, "–" for what is
/// missing. A statistic {"mean","sd"} is "40.12, s.d. 0.46", an estimate {"value","low","high"} "1.50 (1.20 to 1.80)",
/// a list its parts. A verdict may be given as true or false. All have the prefix of the largest; numbers more than ten
/// thousand times apart (a thousand, where each has its uncertainty) carry one each, in their cells.
struct ColumnText {
    QString header;
    QStringList cells;
    bool right = false;
};
[[nodiscard]] ColumnText columnText(const ResultColumn& column, const nlohmann::json& records);

/// A table of Confusion; without rows where the results have none, or one with another number of names.
struct CountsText {
    QStringList down, across;
    std::vector<QStringList> counts;
};
[[nodiscard]] CountsText countsText(const ResultTable& table, const nlohmann::json& results);

/// The tables for results of an unknown kind, a laboratory's own: their numbers, texts and lists of records, with the
/// words of their keys. What is nested deeper is left out.
[[nodiscard]] std::vector<ResultTable> tablesIn(const nlohmann::json& results);

/// The tables of the results' kind; tablesIn() where that is not known.
[[nodiscard]] std::vector<ResultTable> tablesOf(const nlohmann::json& results);

/// A list of texts, or one, as they are shown.
[[nodiscard]] QStringList sentencesIn(const nlohmann::json& value);

/// "✔ pass" on one line, as it stands in a table; a text that is not a verdict stays as it is.
[[nodiscard]] QString verdictCell(const QString& key);
/// "✔"; "–" for any other text.
[[nodiscard]] QString verdictShape(const QString& key);

/// "FDA guidance" of "fda-pms"; "this program" of "gate"; an id that is not known stands as it is.
[[nodiscard]] QString limitSetTitle(const QString& id);
/// The words for a limit that has no number.
inline constexpr const char* kUntilNextTrain = "before the next train";
/// "≤ 40 V" of {"limit", "unit", "compare"}; empty without a limit.
[[nodiscard]] QString limitText(const nlohmann::json& line);
/// The share of a limit that value and U use together, "23 %"; "–" where it is not known.
[[nodiscard]] QString limitShareText(double used_pct);
/// "200 Ω + 10 kΩ ∥ 50 nF" of a load's name.
[[nodiscard]] QString loadText(QString name);

}  // namespace tacto
