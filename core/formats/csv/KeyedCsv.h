// KeyedCsv.h - what the blocks of keys of several makers have in common.
//
// Thread-safety: pure functions.
#pragma once

#include "core/formats/csv/CsvMakers.h"

namespace tacto {

/// "CH1:V,CH2:mV", "CH1:V CH2:mV" or "V,mV": name and value that a line of keys gives channel `index` (from 0). Empty
/// where it does not.
[[nodiscard]] std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index);

/// Sample interval and number of rows, as "Sample Interval" or "Sample Rate", and "Record Length", state them.
void readRecordKeys(const CsvHead& head, CsvLayout& layout);

/// Errors: Unsupported where "Horizontal Units" are stated and not seconds, as in a spectrum.
[[nodiscard]] Result<void> checkHorizontalUnit(const CsvHead& head, std::string_view file);

/// Whether keys stand in columns 1 and 2 of rows whose columns 4 and 5 hold time and value.
[[nodiscard]] bool keysStandBesideRows(const CsvHead& head, std::size_t firstLine);

/// Such a table; its rows begin with header line `firstLine`.
[[nodiscard]] CsvDraft draftBesideKeys(const CsvHead& head, std::size_t firstLine);

}  // namespace tacto
