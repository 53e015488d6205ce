// CsvMakers.h - the dialects of the makers: by what each is known, and how its tables are laid out.
//
// Thread-safety: pure functions.
#pragma once

#include <span>

#include "core/formats/csv/CsvDraft.h"

namespace tacto {

struct CsvMaker {
    CsvDialect dialect;
    std::string_view id;    ///< the format's id: "csv-rigol"
    std::string_view name;  ///< for people
    /// Whether a table that begins so is one of the maker's. The header is not empty or there is a first row.
    bool (*recognises)(const CsvHead& head);
    /// The layout of a table that is recognised. Errors: ParseError naming file and what was expected.
    Result<CsvDraft> (*draft)(const CsvHead& head, std::string_view file);
};

/// In the order in which they are tried. The plain dialect is not among them.
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

}  // namespace tacto
