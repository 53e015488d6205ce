// TableContent.h - tables and matrices of a report as text: numbers with their units; cells that need attention are
// named.
#pragma once

#include "app/report/ReportContent.h"
#include "app/report/ResultCells.h"

namespace tacto {

/// Makes a table from a script's table. If rows have their own `value` and `unit`, then value, expanded_uncertainty and
/// unit become one column, "40.12 ± 0.46 V".
[[nodiscard]] TableBlock tableOf(const ReportTable& source, const QString& caption);
/// Makes a table from declared columns; leaves out columns without a known value.
[[nodiscard]] TableBlock tableOf(const ResultTable& source, const nlohmann::json& records, const QString& caption);
[[nodiscard]] MatrixBlock matrixOf(const ReportMatrix& source, const QString& caption);
/// Shortens long texts as ShownText.h describes.
[[nodiscard]] MatrixBlock shortened(MatrixBlock matrix, const QString& caption);
/// Returns the three limits with the largest used share, each with its load.
[[nodiscard]] TableBlock closestOf(const MatrixBlock& limits, const QString& caption);
/// Gives each column one prefix per unit, in the tables that tableOf() did not make.
void sharePrefixes(std::vector<ReportBlock>& blocks);
[[nodiscard]] TableBlock eventsTable(const ReportModel& model, const QString& caption);

}  // namespace tacto
