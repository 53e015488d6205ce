// CsvColumns.h - what the names of columns say: "voltage_v", "CH1 (mV)", "time [us]", "C1 in V", "t/ms", "CH2V", and
// lines of units below them; and what lines of keys say.
#pragma once

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

struct CsvColumn {
    std::string name;  ///< the name without its unit
    std::string unit;  ///< "s", "V", "A" or ""
    double factor = 1;
    std::string unknownUnit;  ///< a unit that is none of these
};

[[nodiscard]] CsvColumn columnNamed(std::string_view text);

[[nodiscard]] bool isTimeColumn(const CsvColumn& column);

/// readCsvHead(), where the last comment is the header if it names a time and each of the other columns.
[[nodiscard]] CsvHead readCaptureHead(std::string_view text, std::size_t skipRows);

/// Whether every field is in brackets or a unit, and one of them is of time: the second of two header lines.
[[nodiscard]] bool isLineOfUnits(const CsvLine& line);

/// Takes the brackets off a field of the line of units, and a word before the unit ("Unit: mV").
[[nodiscard]] std::string_view unitTextOf(std::string_view field);
/// The unit that such a field names.
[[nodiscard]] std::optional<SpelledUnit> unitField(std::string_view field);

/// Whether a column counts rows: "index", "Sample".
[[nodiscard]] bool isIndexColumn(const CsvColumn& column);

/// The line of the header, or of keys beside rows, with `key` as its first field; capitals and a colon or equals sign
/// at its end are ignored.
[[nodiscard]] const CsvLine* lineCalled(const CsvHead& head, std::string_view key);
/// The second field of that line; empty without one.
[[nodiscard]] std::string_view wordCalled(const CsvHead& head, std::string_view key);
/// The number in it, also behind a colon ("Analog:2e-9").
[[nodiscard]] std::optional<double> numberCalled(const CsvHead& head, std::string_view key);
/// What stands behind `key` and a colon or equals sign in one of the comments.
[[nodiscard]] std::optional<std::string_view> remarkCalled(const CsvHead& head, std::string_view key);

/// "20.0uS", "-25 s" or a bare number, in seconds; nothing for another unit.
[[nodiscard]] std::optional<double> secondsIn(std::string_view text, char point);
/// "50 MHz", "1e+06Hz", "2.5 GSa/s" or a bare number, in Hz.
[[nodiscard]] std::optional<double> hertzIn(std::string_view text, char point);

/// The time between samples as any line of keys or comment states it: "Sample rate: 100 kHz", "Sampling Period,4E-06".
struct StatedInterval {
    double interval_s;
    std::size_t line;  ///< the header line; 0 for a comment
};
[[nodiscard]] std::optional<StatedInterval> intervalStated(const CsvHead& head);

/// The sentence about a column of `line` whose unit the file does not state.
[[nodiscard]] std::string unitNotStated(std::string_view file, const CsvLine& line, std::string_view column);

/// The field of that index; empty where there is no line or no such field.
[[nodiscard]] std::string_view fieldIn(const CsvLine* line, std::size_t index);

/// How many fields a line has without the empty ones at its end.
[[nodiscard]] std::size_t filled(const CsvLine& line);

/// The names that end a header, without empty ones at the end. Whether the columns that are read have names of their
/// own is asked by finished().
[[nodiscard]] std::vector<std::string> namesIn(const CsvLine& line);

}  // namespace tacto
