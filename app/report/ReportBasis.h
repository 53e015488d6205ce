// ReportBasis.h - what the results of a run say about the ground that its verdict stands on.
//
// Read, where present, from the results of the verdict:
//   "kind": "load-safety"                                        which rule is meant where none is stated
//   "decision_rule": text, list of texts, or {"guard_band": text, "coverage": text, ...}
//   "rests_on": list of texts
//   "not_evaluated": list of texts, or of {"title", "reason"}; else what "rows" holds of that verdict
//   "instruments": [{"name", "serial", "channel", "unit", "gain_pct", "offset", "lsb", "probe_pct", "timebase_ppm",
//                    "stated_by"}]
//   "reference": as record.reference() and the sensor calibration's known-reference check
// What is null or missing is unknown, and is said to be (hazard H9).
#pragma once

#include <vector>

#include "app/report/ReportContent.h"
#include "app/report/ReportModel.h"

namespace tacto {

/// Adds what `results` say to `model.basis`; its devices and protocol are filled in already.
void readBasis(const QJsonObject& results, ReportModel& model);

// The text below the verdict on a report's first page: how it was decided, what it rests on, what was not evaluated,
// and who did it and who checked it.

void addFrontPage(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);

}  // namespace tacto
