// PdfTable.h - sets a table on pages.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/report/PdfPages.h"
#include "app/report/ReportContent.h"

namespace tacto {

/// Caption above, rules instead of boxes, numbers to the right. Rows are never split; the header is repeated on every
/// page. Columns that do not fit continue in a further part with the first column repeated.
void setTable(PdfPages& pages, const TableBlock& table);

/// The height below which the table begins on the next page: a heading above it needs as much.
[[nodiscard]] double tableBeginning(const TableBlock& table);

// Sets a matrix on pages.

/// The caption stands above, the legend below. Rows are never split; the header is repeated on every page. Values close
/// to the limit or beyond it are shaded and bold, unevaluated ones hatched: told apart without colour.
void setMatrix(PdfPages& pages, const MatrixBlock& matrix);

/// The height below which the matrix begins on the next page.
[[nodiscard]] double matrixBeginning(const MatrixBlock& matrix);

}  // namespace tacto
