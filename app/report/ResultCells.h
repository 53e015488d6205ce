// ResultCells.h - results as text: the cells of a column, which are the same in window, report and terminal.
#pragma once

#include <QStringList>

#include "core/results/ResultTable.h"

namespace tacto {

/// A column as printed: the header with the unit on a second line, one cell per record, "–" for a missing value. A
/// statistic {"mean","sd"} gives "40.12, s.d. 0.46", an estimate {"value","low","high"} "1.50 (1.20 to 1.80)", a list
/// its parts. A verdict may be true or false. All numbers have the prefix of the largest; numbers more than a factor of
/// ten thousand apart (a thousand if each has its uncertainty) each carry their own prefix in their cells.
struct ColumnText {
    QString header;
    QStringList cells;
    bool right = false;
};
[[nodiscard]] ColumnText columnText(const ResultColumn& column, const nlohmann::json& records);
/// Returns the columns of a table. Where its records have units of their own, which differ, all numbers of one record
/// in its unit have the prefix of the largest: "0.500 V" beside "40.00 V".
[[nodiscard]] std::vector<ColumnText> columnTexts(const std::vector<ResultColumn>& columns,
                                                  const nlohmann::json& records);

/// A table of Confusion; without rows if the results have none, or have a different number of names.
struct CountsText {
    QStringList down, across;
    std::vector<QStringList> counts;
};
[[nodiscard]] CountsText countsText(const ResultTable& table, const nlohmann::json& results);

/// Returns tables for results of an unknown kind, such as a laboratory's own: numbers, texts and lists of records,
/// titled by their keys. More deeply nested values are left out.
[[nodiscard]] std::vector<ResultTable> tablesIn(const nlohmann::json& results);

/// Returns the tables of the results' kind, or tablesIn() if the kind is not known.
[[nodiscard]] std::vector<ResultTable> tablesOf(const nlohmann::json& results);

/// Returns a list of texts, or a single text, as shown to people.
[[nodiscard]] QStringList sentencesIn(const nlohmann::json& value);

/// Returns "✔ pass" on one line, for a table; a text that is not a verdict does not change.
[[nodiscard]] QString verdictCell(const QString& key);
/// Returns "✔"; "–" for any other text.
[[nodiscard]] QString verdictShape(const QString& key);

/// Returns "FDA guidance" for "fda-pms", "this program" for "gate"; an unknown id does not change.
[[nodiscard]] QString limitSetTitle(const QString& id);
/// The text for a limit without a number.
inline constexpr const char* kUntilNextTrain = "before the next train";
/// Returns "≤ 40 V" for {"limit", "unit", "compare"}; empty without a limit.
[[nodiscard]] QString limitText(const nlohmann::json& line);
/// Returns the used share of a limit, including the expanded uncertainty: "23 %"; "–" if not known.
[[nodiscard]] QString limitShareText(double used_pct);
/// Returns "200 Ω + 10 kΩ ∥ 50 nF" for the name of a load.
[[nodiscard]] QString loadText(QString name);

}  // namespace tacto
