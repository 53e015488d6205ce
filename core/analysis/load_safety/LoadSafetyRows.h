// LoadSafetyRows.h - the rows of one load, and what is judged over all loads: trips, the open circuit, the worst case
// over the permitted loads and the outputs to be disclosed. Private to core/analysis.
#pragma once

#include "core/analysis/load_safety/LoadSafety.h"

namespace tacto {

/// |Z| at the end of the leading phase of the commanded train, which is what a measured impedance is compared with.
[[nodiscard]] double expectedOhms(const LoadRecord& record, const LoadSafetyInput& input);

/// Value, accuracy, net charge, every limit that applies, refusals: all that one load was asked.
[[nodiscard]] std::vector<SafetyRow> rowsOf(const LoadRecord& record, const LoadSafetyInput& input);

/// The value of a quantity in a step's reading; not measured for what only a command has, or without an area.
[[nodiscard]] Reading readingOf(const LoadReading& reading, Quantity quantity, const LoadSafetyInput& input);

/// Largest of the steps, quantity by quantity; not measured when one step was not.
[[nodiscard]] LoadReading strongestOf(const LoadRecord& record);

/// Limits on the voltage are judged on the open circuit, measured there, or not evaluated.
[[nodiscard]] std::vector<SafetyRow> openCircuitRows(const LoadSafetyInput& input);
[[nodiscard]] std::vector<SafetyRow> tripRows(const LoadSafetyInput& input);
[[nodiscard]] LoadWorstCase worstCaseOf(const LoadSafetyInput& input);
[[nodiscard]] std::vector<DisclosedOutput> disclosedOf(const LoadSafetyInput& input);

}  // namespace tacto
