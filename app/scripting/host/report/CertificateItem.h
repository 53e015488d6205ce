// CertificateItem.h - the results on a stimulator's calibration certificate: as found and as left, each error with its
// expanded uncertainty U, coverage factor k and tolerance (ISO/IEC 17025:2017, 7.8.4.1).
//
// Levels are commanded without a correction, and the delivered values are measured. The values with a stored correction
// are computed from the same readings: a level c that is programmed to p instead delivers m(c) + g · (p - c), with the
// gain g that was found. Its standard uncertainty is u(m) + |p - c| · u(g), because one instrument read both.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::report {

/// A line that corrects commands, or nothing.
using Correction = std::optional<CalibrationLine>;

/// Returns {"quantity", "title", "unit", "tolerance_pct", "warnings", "measured": rows, "found": rows or null, "left":
/// rows or null} for a result of analysis.calibration(): measured without a correction, found with the correction from
/// `before` the run, left with the correction kept `after` it; null without a correction. A row: {"commanded", "error",
/// "expanded_uncertainty", "coverage_factor", "tolerance", "verdict"}, of the worse sweep direction; null: not
/// measured.
[[nodiscard]] nlohmann::json certifiedQuantity(const nlohmann::json& found, const Correction& before,
                                               const Correction& after);

}  // namespace tacto::host::report
