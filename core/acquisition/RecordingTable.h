// RecordingTable.h - one stream's CSV file, as its entry in recording.json describes it, read into samples.
//
// Thread-safety: pure function.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

struct TableLayout {
    std::string timeColumn;
    double timeDivisor = 1;  ///< file's time / divisor = seconds
    std::vector<std::string> columns;
    double valueFactor = 1;  ///< file's value * factor = SI
};

/// `text` is the file's content, `name` what messages call it. Column names are trimmed, trailing commas and blank
/// rows passed over, "nan" kept as NaN; a last row whose values are all empty is dropped.
/// Errors: ParseError naming line and column: no header, a column that is missing or there twice, a second header
/// line, a cell that is not a number, a row cut short, fewer than 2 rows.
[[nodiscard]] Result<SampleBlock> readTable(std::string_view text, std::string_view name, const TableLayout& layout);

}  // namespace tacto
