// PdfTable.h - draws a table on pages.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/report/PdfPages.h"
#include "app/report/ReportContent.h"

namespace tacto {

/// Prints the caption above the table, rules instead of boxes, numbers on the right. Rows are never split; the header
/// is repeated on every page. Columns that do not fit continue in another part that repeats the first column.
void setTable(PdfPages& pages, const TableBlock& table);

/// Returns the height without which the table begins on the next page; a heading above it needs the same.
[[nodiscard]] double tableBeginning(const TableBlock& table);

// Draws a matrix on pages.

/// Prints the caption above and the legend below. Rows are never split; the header is repeated on every page. Values
/// close to or beyond the limit are shaded and bold, unevaluated values hatched, so that colour is not needed.
void setMatrix(PdfPages& pages, const MatrixBlock& matrix);

/// Returns the height without which the matrix begins on the next page.
[[nodiscard]] double matrixBeginning(const MatrixBlock& matrix);

}  // namespace tacto
