// CsvDraft.h - a table's layout before the options are applied. The dialects make it; CsvLayout.h is the final form.
#pragma once

#include "core/formats/csv/CsvLayout.h"

namespace tacto {

/// Errors in the makers' drafts: ParseError naming file, line and what was expected.
struct CsvDraft {
    /// Rows begin after line `last`; `names` is the line with the column names.
    CsvDraft(const CsvLine& names, const CsvLine& last) {
        layout.headerLine = names.number;
        layout.dataOffset = last.behind;
        layout.dataLine = last.number + 1;
    }
    CsvLayout layout;
    std::vector<ChannelPlan> columns;  ///< all columns except the time, as in the file

    /// Lets the rows begin with line `first`.
    void startAt(const CsvLine& first) noexcept {
        layout.dataOffset = first.offset;
        layout.dataLine = first.number;
    }
    /// Adds a channel for a further column, after those in layout.names. `spelled` is its unit as the file writes it.
    void addChannel(std::string name, std::string_view spelled);
    /// Adds a column whose name contains its unit.
    void addNamed(const std::string& named);
    /// Adds a column that will not be read.
    void addOther(std::string name) { layout.names.push_back(std::move(name)); }
    /// Sets rows `interval_s` apart, from `start_s` on. If the interval is not finite and above 0, the options must
    /// give a rate. `stated` is the interval as the file writes it.
    void countRows(std::optional<double> interval_s, double start_s, std::string_view stated, std::string_view file);
};

/// Makes a draft from a line of names and a line of units. The first column is time. Empty last fields are ignored.
[[nodiscard]] CsvDraft twoLineDraft(const CsvLine& names, const CsvLine& units, std::size_t width);

/// Returns the layout of a plain table. Errors: ParseError if no line names a time column and channels, nor do options.
[[nodiscard]] Result<CsvDraft> plainDraft(const CsvHead& head, const ReadOptions& options, std::string_view file);

/// Applies the options: time column, rate, chosen columns, units, probes. Columns with text or other quantities are
/// left out with a warning, unless they were chosen. Errors: as layOut().
[[nodiscard]] Result<CsvLayout> finished(CsvDraft draft, const CsvHead& head, const ReadOptions& options,
                                         std::string_view file);

/// Returns the column that `wanted` means: its text, its name without the unit, or its number from 1.
[[nodiscard]] std::optional<std::size_t> columnCalled(const std::vector<std::string>& names, std::string_view wanted);

}  // namespace tacto
