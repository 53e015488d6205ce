// CsvMakers.h - the dialects of the makers: by what each is known, and how its tables are laid out.
#pragma once

#include <span>

#include "core/formats/csv/CsvDraft.h"

namespace tacto {

struct CsvMaker {
    CsvDialect dialect;
    std::string_view id;    ///< the format's id: "csv-rigol"
    std::string_view name;  ///< for people
    /// Whether a table that begins in this way is one of the maker's. The header is not empty, or there is a first row.
    bool (*recognises)(const CsvHead& head);
    /// The layout of a table that is recognised. Errors: ParseError naming file and what was expected.
    Result<CsvDraft> (*draft)(const CsvHead& head, std::string_view file);
};

/// The makers in the order in which they are tried. The plain dialect is not among them.
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

// What the blocks of keys of several makers have in common.

/// "CH1:V,CH2:mV", "CH1:V CH2:mV" or "V,mV": name and value that a line of keys gives channel `index` (from 0). Empty
/// where it does not.
[[nodiscard]] std::pair<std::string, std::string> keyedValue(const CsvLine* line, std::size_t index);

/// Sample interval and number of rows, as "Sample Interval" or "Sample Rate", and "Record Length", state them.
void readRecordKeys(const CsvHead& head, CsvLayout& layout);

/// Errors: Unsupported where "Horizontal Units" are stated and not seconds, as in a spectrum.
[[nodiscard]] Result<void> checkHorizontalUnit(const CsvHead& head, std::string_view file);

/// Whether keys stand in columns 1 and 2 of rows whose columns 4 and 5 hold time and value.
[[nodiscard]] bool keysStandBesideRows(const CsvHead& head, std::size_t firstLine);

/// The draft of such a table; its rows begin with header line `firstLine`.
[[nodiscard]] CsvDraft draftBesideKeys(const CsvHead& head, std::size_t firstLine);

}  // namespace tacto
