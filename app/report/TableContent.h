// TableContent.h - tables and matrices of a report, worded: numbers as text with their units, what needs attention
// named.
//
// Thread-safety: pure functions.
#pragma once

#include "app/report/ReportContent.h"

namespace tacto {

/// A script's table. Where rows have a `value` and a `unit` of their own, value, expanded_uncertainty and unit are one
/// column, "40.12 ± 0.46 V".
[[nodiscard]] TableBlock tableOf(const ReportTable& source, const QString& caption);
[[nodiscard]] MatrixBlock matrixOf(const ReportMatrix& source, const QString& caption);
/// One prefix for each unit in each column of the tables that were not made by tableOf().
void sharePrefixes(std::vector<ReportBlock>& blocks);
[[nodiscard]] TableBlock eventsTable(const ReportModel& model, const QString& caption);

/// "FDA guidance" of "fda-pms"; "this program" of "gate"; an id that is not known
/// stands as it is.
[[nodiscard]] QString limitSetTitle(const QString& id);
/// The share of a limit that value and U use together, "23 %"; "–" where it is not known.
[[nodiscard]] QString limitShareText(double used_pct);
/// "200 Ω + 10 kΩ ∥ 50 nF" of a load's name.
[[nodiscard]] QString loadText(QString name);

}  // namespace tacto
