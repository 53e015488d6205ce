// CsvDraft.h - a table's layout before the options are heard: what the dialects make and CsvLayout.h gives away.
#pragma once

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Errors of the makers' drafts: ParseError naming file, line and what was expected.
struct CsvDraft {
    /// Rows begin behind `last`; `names` is the line that names the columns.
    CsvDraft(const CsvLine& names, const CsvLine& last) {
        layout.headerLine = names.number;
        layout.dataOffset = last.behind;
        layout.dataLine = last.number + 1;
    }
    CsvLayout layout;
    std::vector<ChannelPlan> columns;  ///< all but the time, as the file has them

    /// Rows begin with `first`.
    void startAt(const CsvLine& first) noexcept {
        layout.dataOffset = first.offset;
        layout.dataLine = first.number;
    }
    /// Adds a channel for another column, behind those in layout.names. `spelled` is its unit as written in the file.
    void addChannel(std::string name, std::string_view spelled);
    /// Adds a column whose name says its unit.
    void addNamed(const std::string& named);
    /// Adds a column that is not read.
    void addOther(std::string name) { layout.names.push_back(std::move(name)); }
    /// The rows are apart by `interval_s`, from `start_s` on. Where it is not finite and above 0 the table needs a rate
    /// from the options; `stated` is how the file writes it.
    void countRows(std::optional<double> interval_s, double start_s, std::string_view stated, std::string_view file);
};

/// Names in one line, units in the next; the first column is time. Empty fields at the end are not columns.
[[nodiscard]] CsvDraft twoLineDraft(const CsvLine& names, const CsvLine& units, std::size_t width);

/// The layout of a plain table. Errors: ParseError where no line names a time column and channels, and no option helps.
[[nodiscard]] Result<CsvDraft> plainDraft(const CsvHead& head, const ReadOptions& options, std::string_view file);

/// Applies the options: time column, rate, choice, units, probes. Columns of text and of other quantities are left out
/// with a warning, unless they were chosen. Errors: as layOut().
[[nodiscard]] Result<CsvLayout> finished(CsvDraft draft, const CsvHead& head, const ReadOptions& options,
                                         std::string_view file);

/// The column that `wanted` names: its text, its name without the unit, or its number from 1.
[[nodiscard]] std::optional<std::size_t> columnCalled(const std::vector<std::string>& names, std::string_view wanted);

}  // namespace tacto
