// CsvDraft.h - a table's layout before the options are heard: what the dialects make and CsvLayout.h gives away.
//
// Thread-safety: pure functions.
#pragma once

#include "core/formats/CsvLayout.h"

namespace tacto {

struct CsvDraft {
    /// Rows begin behind `last`; `names` is the line that names the columns.
    CsvDraft(const CsvLine& names, const CsvLine& last) {
        layout.headerLine = names.number;
        layout.dataOffset = last.behind;
        layout.dataLine = last.number + 1;
    }
    CsvLayout layout;
    std::vector<ChannelPlan> columns;  ///< all but the time, as the file has them
};

/// Of a plain table. Errors: ParseError where no line names a time column and channels, and no option helps.
[[nodiscard]] Result<CsvDraft> plainDraft(const CsvHead& head, const ReadOptions& options, std::string_view file);

/// With the options: time column, rate, choice, units, probes.
/// Errors: as layOut().
[[nodiscard]] Result<CsvLayout> finished(CsvDraft draft, const ReadOptions& options, std::string_view file);

/// The column that `wanted` names: its text, its name without the unit, or its number from 1.
[[nodiscard]] std::optional<std::size_t> columnCalled(const std::vector<std::string>& names, std::string_view wanted);

}  // namespace tacto
