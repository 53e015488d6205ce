// LoadSafetyRows.h - makes the rows of one load, and the rows over all loads: trips, the open circuit, the worst case
// over the permitted loads and the outputs to disclose. Private to core/analysis.
#pragma once

#include "core/analysis/load_safety/LoadSafety.h"

namespace tacto {

/// Expected |Z| at the end of the leading phase of the commanded train, to compare with a measured impedance.
[[nodiscard]] double expectedOhms(const LoadRecord& record, const LoadSafetyInput& input);

/// Returns all rows of one load: its value, accuracy, net charge, every applicable limit, and refusals.
[[nodiscard]] std::vector<SafetyRow> rowsOf(const LoadRecord& record, const LoadSafetyInput& input);

/// Returns a quantity from a step's reading; not measured if only a command has it, or if it needs an unknown area.
[[nodiscard]] Reading readingOf(const LoadReading& reading, Quantity quantity, const LoadSafetyInput& input);

/// Returns for each quantity the largest value of all steps; not measured if it is missing in any step.
[[nodiscard]] LoadReading strongestOf(const LoadRecord& record);

/// Judges the voltage limits by the measurement on the open circuit; without this measurement they are not evaluated.
[[nodiscard]] std::vector<SafetyRow> openCircuitRows(const LoadSafetyInput& input);
[[nodiscard]] std::vector<SafetyRow> tripRows(const LoadSafetyInput& input);
[[nodiscard]] LoadWorstCase worstCaseOf(const LoadSafetyInput& input);
[[nodiscard]] std::vector<DisclosedOutput> disclosedOf(const LoadSafetyInput& input);

}  // namespace tacto
