// CsvColumns.h - reads the names of columns: "voltage_v", "CH1 (mV)", "time [us]", "C1 in V", "t/ms", "CH2V", lines of
// units below them, and lines of keys.
#pragma once

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

struct CsvColumn {
    std::string name;  ///< name without its unit
    std::string unit;  ///< "s", "V", "A" or ""
    double factor = 1;
    std::string unknownUnit;  ///< a unit other than these
};

[[nodiscard]] CsvColumn columnNamed(std::string_view text);

[[nodiscard]] bool isTimeColumn(const CsvColumn& column);

/// Calls readCsvHead(), and takes the last comment as the header if it names a time and each other column.
[[nodiscard]] CsvHead readCaptureHead(std::string_view text, std::size_t skipRows);

/// Returns whether every field is in brackets or a unit, and one is a unit of time: the second of two header lines.
[[nodiscard]] bool isLineOfUnits(const CsvLine& line);

/// Removes the brackets from a field in a line of units, and a word before the unit ("Unit: mV").
[[nodiscard]] std::string_view unitTextOf(std::string_view field);
/// Returns the unit in such a field.
[[nodiscard]] std::optional<SpelledUnit> unitField(std::string_view field);

/// Returns whether a column counts rows: "index", "Sample".
[[nodiscard]] bool isIndexColumn(const CsvColumn& column);

/// Returns the line of the header, or of keys next to rows, whose first field is `key`. Case, and a colon or equals
/// sign at the end, are ignored.
[[nodiscard]] const CsvLine* lineCalled(const CsvHead& head, std::string_view key);
/// Returns the second field of that line, or an empty text.
[[nodiscard]] std::string_view wordCalled(const CsvHead& head, std::string_view key);
/// Returns the number in that field, also after a colon ("Analog:2e-9").
[[nodiscard]] std::optional<double> numberCalled(const CsvHead& head, std::string_view key);
/// Returns the text after `key` and a colon or equals sign in a comment.
[[nodiscard]] std::optional<std::string_view> remarkCalled(const CsvHead& head, std::string_view key);

/// Reads "20.0uS", "-25 s" or a bare number as seconds; returns nothing for another unit.
[[nodiscard]] std::optional<double> secondsIn(std::string_view text, char point);
/// Reads "50 MHz", "1e+06Hz", "2.5 GSa/s" or a bare number as Hz.
[[nodiscard]] std::optional<double> hertzIn(std::string_view text, char point);

/// The time between samples, if a line of keys or a comment states it: "Sample rate: 100 kHz", "Sampling Period,4E-06".
struct StatedInterval {
    double interval_s;
    std::size_t line;  ///< number of the header line; 0 for a comment
};
[[nodiscard]] std::optional<StatedInterval> intervalStated(const CsvHead& head);

/// Returns the sentence about a column of `line` for which the file states no unit.
[[nodiscard]] std::string unitNotStated(std::string_view file, const CsvLine& line, std::string_view column);

/// Returns the field with that index, or an empty text without such a line or field.
[[nodiscard]] std::string_view fieldIn(const CsvLine* line, std::size_t index);

/// Returns the number of fields in a line, without empty ones at its end.
[[nodiscard]] std::size_t filled(const CsvLine& line);

/// Returns the names in the last header line, without empty ones at the end. finished() checks that the columns to be
/// read have names of their own.
[[nodiscard]] std::vector<std::string> namesIn(const CsvLine& line);

}  // namespace tacto
