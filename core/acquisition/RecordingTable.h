// RecordingTable.h - one stream's table, as its entry in recording.json describes it, read into samples.
//
// Text in UTF-8, Latin-1 or UTF-16; comma, semicolon or tab between cells; decimal points or commas. Lines before the
// header are passed over where columns are called by name, and so is all before the first row of numbers where they
// are called by number; a line of units below the header must not contradict the layout.
//
// An empty cell is a missing value, as "nan" is. A row without any value of this stream is a sample that is missing
// where one was due, by the rate of the others; where none was due, the row is another stream's in the same table, and
// passed over. So are such rows at the end.
//
// Thread-safety: pure function.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

/// A column by its name in the header, or by its number from 1.
using ColumnChoice = std::variant<std::string, std::size_t>;

struct TableLayout {
    std::optional<ColumnChoice> timeColumn{};  ///< nothing: each row follows the last one at `rate_hz`, from 0 s on
    double timeDivisor = 1;                    ///< file's time / divisor = seconds
    std::vector<ColumnChoice> columns{};
    double valueFactor = 1;         ///< file's value * factor = SI
    double rate_hz = 0;             ///< above 0 without a time column
    std::size_t skipRows = 0;       ///< lines of the file that do not belong to the table
    std::optional<char> decimal{};  ///< '.' or ','; nothing: as the table shows
};

/// `text` is the file's content, `name` what messages call it. Column names are trimmed, trailing separators and blank
/// rows passed over.
/// Errors: ParseError naming line and column: a column that is missing or there twice, a second header line, units
/// that contradict the layout, a cell that is not a number, a row cut short, fewer than 2 rows, a single comma in each
/// row that may be a decimal comma or not.
[[nodiscard]] Result<SampleBlock> readTable(std::string_view text, std::string_view name, const TableLayout& layout);

}  // namespace tacto
