// CertificateItem.h - what a stimulator's calibration certificate says of its results: as found and as left, each error
// with its U, k and tolerance (ISO/IEC 17025:2017, 7.8.4.1).
//
// Levels are commanded without a correction, so what they deliver then is measured. What they deliver with a stored
// correction is computed from the same readings: a level that is programmed to p in place of c delivers
// m(c) + g · (p - c), with the gain g that was found, and its standard uncertainty is u(m) + |p - c| · u(g): one
// instrument read both.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::report {

/// A line by which commands are corrected, or none.
using Correction = std::optional<CalibrationLine>;

/// {"quantity", "title", "unit", "tolerance_pct", "warnings", "measured": rows, "found": rows or null, "left": rows or
/// null} of what analysis.calibration() found: measured without a correction, found with the one of `before` the run,
/// left with the one that is kept `after` it; null where there is none. A row: {"commanded", "error",
/// "expanded_uncertainty", "coverage_factor", "tolerance", "verdict"}, of the worse sweep direction; null for what was
/// not measured.
[[nodiscard]] nlohmann::json certifiedQuantity(const nlohmann::json& found, const Correction& before,
                                               const Correction& after);

}  // namespace tacto::host::report
