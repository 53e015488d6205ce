// CsvHead.h - reads the start of a table: where its header ends and its numbers begin, and the separator.
//
// Accepts, like core/base/Csv.h, CR LF, blank lines, `#` comment lines, quoted fields, trailing separators; also comma,
// semicolon, tab or blanks between fields, and lines that begin with `%`. Lines that begin with `;` are comments too
// unless semicolons separate fields. Decimal commas are accepted if commas do not separate fields and the fields are
// numbers only in this way.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tacto {

/// One line that is neither blank nor a comment.
struct CsvLine {
    std::size_t number = 0;           ///< number of the line in the file, from 1
    std::size_t offset = 0;           ///< position of the line's first byte in the text
    std::size_t behind = 0;           ///< position of the next line
    std::vector<std::string> fields;  ///< trimmed, without quotes, in UTF-8
};

struct CsvHead {
    std::vector<std::string> remarks;  ///< the comments before the first row of numbers, without comment marks
    std::vector<CsvLine> header;       ///< the lines before the first row of numbers; all lines if there is no such row
    std::optional<CsvLine> firstRow;   ///< the first line whose fields are numbers, stamps or empty
    std::vector<CsvLine> body;         ///< some lines from the first row on
    std::vector<CsvLine> beside;       ///< the lines of `body` that begin with a key (csv/CsvMakers.h)
    char separator = ',';              ///< ' ': any number of blanks and tabs
    char point = '.';
};

/// Whether a line is blank, or a comment that begins with # or (Octave) with %.
[[nodiscard]] bool isPassedOver(std::string_view line);

/// Parses a number in a table: also nan, inf and ∞ (PicoScope writes ∞ beyond the range; read as inf).
[[nodiscard]] std::optional<double> fieldNumber(std::string_view field, char point);

/// Removes brackets around the whole field: "(mV)", "[s]".
[[nodiscard]] std::string_view withoutBrackets(std::string_view field) noexcept;

/// Analyses `text`, the start of a file in whole lines (the last may be cut off), after skipping `skipRows` lines.
[[nodiscard]] CsvHead readCsvHead(std::string_view text, std::size_t skipRows);

// Columns separated by blanks (numpy.savetxt, Octave, gnuplot, LeCroy's ASCII). Any number of blanks and tabs is one
// separator (' ' in CsvHead), also before the first column and after the last: no field can be empty.

/// Whether most lines contain only two or more numbers, separated by blanks.
[[nodiscard]] bool areApartByBlanks(std::span<const std::string_view> lines);

/// Whether single tabs separate the fields of such lines, so that a field may be empty: all rows have the same number
/// of tabs, with a number or nothing between two tabs, and no column between two numbers is empty in all rows. A tab
/// before the first number starts a column if a line of words has tabs too.
[[nodiscard]] bool areApartByTabs(std::span<const std::string_view> lines);

/// Cuts a line into fields, for any separator of CsvHead.
void cutRow(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// Returns the names of `width` columns. A name may contain blanks if two blanks or a tab separate the names, or if a
/// unit follows each name ("Time (s)  Channel A (V)"). Otherwise every blank separates names.
[[nodiscard]] std::vector<std::string_view> namesApartByBlanks(std::string_view line, std::size_t width);

}  // namespace tacto
