// CsvTable.h - a capture out of a table whose layout is known.
//
// Thread-safety: none; one owner of the text at a time.
#pragma once

#include "core/formats/TextBlocks.h"
#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Reads all rows in one pass, holding the samples and one block; of a long table whose times are not plainly even the
/// times a second time, and holds them. Rows at the end in which no channel has a value are
/// left out, other missing values are NaN; both with a warning, as stamps that are coarse, stray, or disagree with the
/// header's interval.
/// Errors: Io, Stopped; ParseError naming the line where a field or row is wrong, a time is missing or time does not
/// rise in even steps (within half a step), and for fewer than two rows.
[[nodiscard]] Result<CaptureReading> readCsvTable(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout,
                                                  const ReadWatch& watch);

}  // namespace tacto
