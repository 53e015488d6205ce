// LoadSafetyRows.h - the rows of one load. Private to core/analysis.
//
// Thread-safety: pure functions.
#pragma once

#include "core/analysis/load_safety/LoadSafety.h"

namespace tacto {

/// |Z| at the end of the leading phase of the commanded train, which is what a measured impedance is compared with.
[[nodiscard]] double expectedOhms(const LoadRecord& record, const LoadSafetyInput& input);

/// Value, accuracy, net charge, every limit that applies, refusals: all that one load was asked.
[[nodiscard]] std::vector<SafetyRow> rowsOf(const LoadRecord& record, const LoadSafetyInput& input);

/// What a step's reading says about a quantity; not measured for what only a command has, or without an area.
[[nodiscard]] Reading readingOf(const LoadReading& reading, Quantity quantity, const LoadSafetyInput& input);

}  // namespace tacto
