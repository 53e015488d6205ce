// RecordingTable.h - reads one stream's samples from a table that recording.json describes.
//
// Text may be UTF-8, Latin-1 or UTF-16, with comma, semicolon or tab between cells and decimal points or commas. If
// columns are given by name, lines before the header are skipped; if by number, all lines before the first row of
// numbers. A line of units below the header must agree with the layout.
//
// An empty cell or "nan" is a missing value. A row without any value of this stream is a missing sample if the rate of
// the others makes one due. If none was due, the row belongs to another stream in the same table and is skipped, as are
// such rows at the end.
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

/// A column, given by its name in the header or its number from 1.
using ColumnChoice = std::variant<std::string, std::size_t>;

struct TableLayout {
    std::optional<ColumnChoice> timeColumn{};  ///< nothing: rows follow each other at `rate_hz`, from 0 s on
    double timeDivisor = 1;                    ///< seconds = the file's time / divisor
    std::vector<ColumnChoice> columns{};
    double valueFactor = 1;         ///< SI value = the file's value * factor
    double rate_hz = 0;             ///< above 0 if there is no time column
    std::size_t skipRows = 0;       ///< lines at the beginning of the file that are not part of the table
    std::optional<char> decimal{};  ///< '.' or ','; nothing: found from the table
};

/// `text` is the content of the file, `name` its name in messages. Column names are trimmed; trailing separators and
/// blank rows are ignored. Errors: ParseError naming line and column: a column that is missing or occurs twice, a
/// second header line, units that contradict the layout, a cell that is not a number, a row cut short, fewer than 2
/// rows, or a single comma in each row that may or may not be a decimal comma.
[[nodiscard]] Result<SampleBlock> readTable(std::string_view text, std::string_view name, const TableLayout& layout);

}  // namespace tacto
