// CsvColumns.h - what the names of columns say: "voltage_v", "CH1 (mV)", "time [us]", and lines of units below them.
//
// Thread-safety: pure functions.
#pragma once

#include "core/formats/CsvLayout.h"

namespace tacto {

struct CsvColumn {
    std::string name;  ///< without its unit
    std::string unit;  ///< "s", "V", "A" or ""
    double factor = 1;
    std::string unknownUnit;  ///< a bracketed unit that nobody understands
};

[[nodiscard]] CsvColumn columnNamed(std::string_view text);

[[nodiscard]] bool isTimeColumn(const CsvColumn& column);

/// Whether every field is a unit, in brackets or spelled out, and there is at least one: the second of two header
/// lines.
[[nodiscard]] bool isLineOfUnits(const CsvLine& line);

/// The unit in a field of such a line.
[[nodiscard]] std::optional<SpelledUnit> unitField(std::string_view field);

/// The header line whose first field is `key`, capitals and a colon at its end ignored.
[[nodiscard]] const CsvLine* lineCalled(const CsvHead& head, std::string_view key);
/// The number in the second field of that line, also behind a colon ("Analog:2e-9").
[[nodiscard]] std::optional<double> numberCalled(const CsvHead& head, std::string_view key);

/// The names that end a header, without empty ones at the end.
/// Errors: ParseError where a column has no name or two have the same.
[[nodiscard]] Result<std::vector<std::string>> namesIn(const CsvLine& line, std::string_view file);

}  // namespace tacto
