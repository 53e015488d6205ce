// TableContent.h - tables and matrices of a report, worded: numbers as text with their units, what needs attention
// named.
#pragma once

#include "app/report/ReportContent.h"
#include "app/report/ResultCells.h"

namespace tacto {

/// A script's table. Where rows have a `value` and a `unit` of their own, value, expanded_uncertainty and unit are one
/// column, "40.12 ± 0.46 V".
[[nodiscard]] TableBlock tableOf(const ReportTable& source, const QString& caption);
[[nodiscard]] MatrixBlock matrixOf(const ReportMatrix& source, const QString& caption);
/// Long texts are cut as ShownText.h says.
[[nodiscard]] MatrixBlock shortened(MatrixBlock matrix, const QString& caption);
/// The three limits that are used the most, each on its load.
[[nodiscard]] TableBlock closestOf(const MatrixBlock& limits, const QString& caption);
/// One prefix for each unit in each column of the tables that were not made by tableOf().
void sharePrefixes(std::vector<ReportBlock>& blocks);
[[nodiscard]] TableBlock eventsTable(const ReportModel& model, const QString& caption);

}  // namespace tacto
