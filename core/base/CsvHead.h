// CsvHead.h - the beginning of a table: where its header ends and its numbers begin, what separates them.
//
// Tolerated, as in core/base/Csv.h: CR LF, blank lines, `#` comment lines, quoted fields, trailing separators; comma,
// semicolon, tab or blanks between fields; lines that begin with `%`. Lines that begin with `;` are
// comments too where fields are separated by something else. A decimal comma is taken where fields
// are separated by something else and hold numbers only so.
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
    std::size_t number = 0;           ///< in the file, from 1
    std::size_t offset = 0;           ///< place of its first byte, from the beginning of the text
    std::size_t behind = 0;           ///< place of the line after it
    std::vector<std::string> fields;  ///< trimmed, without quotes, in UTF-8
};

struct CsvHead {
    std::vector<std::string> remarks;  ///< the comments before the first row of numbers, without their marks
    std::vector<CsvLine> header;       ///< the lines before the first row of numbers; all that were seen where none is
    std::optional<CsvLine> firstRow;   ///< the first line whose fields are numbers, stamps or empty
    std::vector<CsvLine> body;         ///< some lines from the first row on
    std::vector<CsvLine> beside;       ///< the lines of them that begin with a key (csv/CsvMakers.h)
    char separator = ',';              ///< ' ': any number of blanks and tabs
    char point = '.';
};

/// A line without fields: blank, or a comment that begins with # or, as Octave writes it, with %.
[[nodiscard]] bool isPassedOver(std::string_view line);

/// A number as tables have them: also nan, inf, ∞ (what PicoScope writes beyond the range; read as inf).
[[nodiscard]] std::optional<double> fieldNumber(std::string_view field, char point);

/// A field without the brackets about all of it: "(mV)", "[s]".
[[nodiscard]] std::string_view withoutBrackets(std::string_view field) noexcept;

/// Looks at `text`, the file's beginning in whole lines (a last one that is cut off counts), after `skipRows` lines.
[[nodiscard]] CsvHead readCsvHead(std::string_view text, std::size_t skipRows);

// Columns that are apart by blanks: numpy.savetxt, Octave, gnuplot, LeCroy's ASCII. Any number of blanks
// and tabs is one separator (' ' in CsvHead), also before the first column and behind the last: no field is empty.

/// Whether most of the lines hold nothing but two or more numbers with blanks between them.
[[nodiscard]] bool areApartByBlanks(std::span<const std::string_view> lines);

/// Whether single tabs divide such lines, where a field may be empty. Rows agree in their tabs, with a number
/// or nothing between two of them, and no gap between two numbers in all rows; one before the first number is a column
/// where a line of words has tabs too.
[[nodiscard]] bool areApartByTabs(std::span<const std::string_view> lines);

/// The fields of a line, by any separator of CsvHead.
void cutRow(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// The names of `width` columns: a name may have blanks in it where two or a tab are between names, or where a unit
/// follows it ("Time (s)  Channel A (V)"). What cannot be so is cut at every blank.
[[nodiscard]] std::vector<std::string_view> namesApartByBlanks(std::string_view line, std::size_t width);

}  // namespace tacto
