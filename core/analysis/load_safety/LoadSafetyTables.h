// LoadSafetyTables.h - what is judged over all loads: trips, the open circuit, the worst case over the permitted loads
// and the outputs to be disclosed. Private to core/analysis.
//
// Thread-safety: pure functions.
#pragma once

#include "core/analysis/load_safety/LoadSafety.h"

namespace tacto {

/// Largest of the steps, quantity by quantity; not measured when one step was not.
[[nodiscard]] LoadReading strongestOf(const LoadRecord& record);

/// Limits on the voltage are judged on the open circuit, measured there, or not evaluated.
[[nodiscard]] std::vector<SafetyRow> openCircuitRows(const LoadSafetyInput& input);
[[nodiscard]] std::vector<SafetyRow> tripRows(const LoadSafetyInput& input);
[[nodiscard]] LoadWorstCase worstCaseOf(const LoadSafetyInput& input);
[[nodiscard]] std::vector<DisclosedOutput> disclosedOf(const LoadSafetyInput& input);

}  // namespace tacto
