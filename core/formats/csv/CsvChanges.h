// CsvChanges.h - draws tables of logic analysers that have a row for each change of a level and none between (Saleae
// Logic 2, DSView). Such rows are not samples in even steps.
//
// The levels are drawn as samples, from each change to the next. If an edge is not half-way between two samples, one
// sample gets a value between the levels, so that a straight line crosses the middle at the time of the edge. Widths
// and intervals then agree exactly with the stamps.
#pragma once

#include <span>

#include "core/formats/CaptureFormat.h"

namespace tacto {

/// Returns whether rows can only be changes: only 0 and 1 without a unit, at least three rows, and each differs from
/// the row before. The last row may only mark the record's end.
[[nodiscard]] bool listsChanges(const std::vector<CaptureChannel>& channels);

/// Returns whether rows can only be changes in a larger table, of which some columns were chosen. A row may be a change
/// in another column, so the stamps decide: they rise, in steps of which less than half are equal.
[[nodiscard]] bool listsChangesOfMore(const std::vector<CaptureChannel>& channels, std::span<const double> stamps_s);

/// Draws the levels of `reading` between its rows at `stamps_s`, and sets rate and start. The last level is drawn as
/// long as the shortest one. Errors: ParseError naming `file`: times that do not rise, or levels so short and a record
/// so long that more than 64 million samples in all channels would be needed.
[[nodiscard]] Result<void> drawLevels(std::span<const double> stamps_s, CaptureReading& reading, std::string_view file);

}  // namespace tacto
