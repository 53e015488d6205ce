// CsvMakers.h - the makers' dialects: how each is recognised and how its tables are laid out.
#pragma once

#include <span>

#include "core/formats/csv/CsvDraft.h"

namespace tacto {

struct CsvMaker {
    CsvDialect dialect;
    std::string_view id;    ///< id of the format: "csv-rigol"
    std::string_view name;  ///< name for people
    /// Returns whether a table with this beginning comes from the maker. It must have a header or a first row.
    bool (*recognises)(const CsvHead& head);
    /// Returns the layout of a recognised table. Errors: ParseError naming file and what was expected.
    Result<CsvDraft> (*draft)(const CsvHead& head, std::string_view file);
};

/// Returns the makers in the order in which they are tried, without the plain dialect.
[[nodiscard]] std::span<const CsvMaker> csvMakers() noexcept;

extern const CsvMaker kRigolCsv;
extern const CsvMaker kSiglentCsv;
extern const CsvMaker kTektronixCsv;
extern const CsvMaker kKeysightCsv;
extern const CsvMaker kPicoScopeCsv;
extern const CsvMaker kLeCroyCsv;
extern const CsvMaker kHantekCsv;
extern const CsvMaker kOwonCsv;
extern const CsvMaker kGwInstekCsv;
extern const CsvMaker kYokogawaCsv;
extern const CsvMaker kMicsigCsv;
extern const CsvMaker kSigrokCsv;
extern const CsvMaker kLabViewCsv;

// Functions for blocks of keys that several makers share.

/// Returns the name and value that a line of keys gives to channel `index` (from 0): "CH1:V,CH2:mV", "CH1:V CH2:mV" or
/// "V,mV". Both are empty if it gives none.
[[nodiscard]] std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index);

/// Reads the interval from "Sample Interval" or "Sample Rate", and the number of rows from "Record Length".
void readRecordKeys(const CsvHead& head, CsvLayout& layout);

/// Errors: Unsupported if "Horizontal Units" are stated and are not seconds, as in a spectrum.
[[nodiscard]] Result<void> checkHorizontalUnit(const CsvHead& head, std::string_view file);

/// Returns whether rows have keys in columns 1 and 2, and time and value in columns 4 and 5.
[[nodiscard]] bool keysStandBesideRows(const CsvHead& head, std::size_t firstLine);

/// Returns the draft of such a table, with rows from header line `firstLine` on.
[[nodiscard]] CsvDraft draftBesideKeys(const CsvHead& head, std::size_t firstLine);

}  // namespace tacto
