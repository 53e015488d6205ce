// ReportBasis.h - reads what the results of a run say about the basis of its verdict.
//
// These members of the verdict's results are read, if present:
//   "kind": "load-safety"                                        which rule applies if none is stated
//   "decision_rule": text, list of texts, or {"guard_band": text, "coverage": text, ...}
//   "rests_on": list of texts
//   "not_evaluated": list of texts, or of {"title", "reason"}; else the "rows" with that verdict
//   "instruments": [{"name", "serial", "channel", "unit", "gain_pct", "offset", "lsb", "probe_pct", "timebase_ppm",
//                    "stated_by"}]
//   "reference": as record.reference() and the sensor calibration's known-reference check
// Null or missing means unknown, and the report says so (hazard H9).
#pragma once

#include <vector>

#include "app/report/ReportContent.h"
#include "app/report/ReportModel.h"

namespace tacto {

/// Adds the basis in `results` to `model.basis`. The devices and protocol of `model` must be filled in already.
void readBasis(const QJsonObject& results, ReportModel& model);

// The text below the verdict on a report's first page: how the verdict was made, its basis, what was not evaluated, and
// who did and who checked the work.

void addFrontPage(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);

}  // namespace tacto
