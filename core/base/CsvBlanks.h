// CsvBlanks.h - columns that are apart by blanks: numpy.savetxt, Octave, gnuplot, LeCroy's ASCII. Any number of blanks
// and tabs is one separator (' ' in CsvHead), also before the first column and behind the last: no field is empty.
//
// Thread-safety: pure functions.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace tacto {

/// Whether most of the lines are two numbers or more with blanks between them, and nothing else.
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
