// PdfMatrix.h - sets a matrix on pages.
//
// Thread-safety: the GUI thread.
#pragma once

#include "app/report/PdfPages.h"
#include "app/report/ReportContent.h"

namespace tacto {

/// Caption above, legend below. Rows are never split; the header is repeated on every page. What is close to its limit
/// or beyond is shaded and bold, what was not evaluated hatched: told apart without colour.
void setMatrix(PdfPages& pages, const MatrixBlock& matrix);

/// The height below which the matrix begins on the next page.
[[nodiscard]] double matrixBeginning(const MatrixBlock& matrix);

}  // namespace tacto
