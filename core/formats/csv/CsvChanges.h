// CsvChanges.h - tables of logic analysers that have a row where a level changes, and none between (Saleae Logic 2,
// DSView): not samples, and with samples' even steps never.
//
// The levels are drawn as samples, from each change to the next. An edge that does not come half-way between two
// samples is a sample between the levels, so that a straight line crosses the middle just then: widths and intervals
// are exactly those of the stamps.
#pragma once

#include <span>

#include "core/formats/CaptureFormat.h"

namespace tacto {

/// Whether these rows can only be changes: nothing but 0 and 1 without a unit, three rows or more, and each differs
/// from the row before it. The last may be the record's end alone.
[[nodiscard]] bool listsChanges(const std::vector<CaptureChannel>& channels);

/// Whether rows can only be the changes of some columns of a larger table: a row may be the change of another column,
/// so that the stamps tell. They rise in steps of which less than half are alike.
[[nodiscard]] bool listsChangesOfMore(const std::vector<CaptureChannel>& channels, std::span<const double> stamps_s);

/// Draws the levels of `reading` between its rows, whose times are `stamps_s`, and sets rate and start. The last level
/// is drawn as long as the shortest one.
/// Errors: ParseError naming `file`: times that do not rise, and levels so short in a record so long that they would be
/// more than 64 million samples in all channels.
[[nodiscard]] Result<void> drawLevels(std::span<const double> stamps_s, CaptureReading& reading, std::string_view file);

}  // namespace tacto
