// StudyPredicted.h - what a model of a person with the thresholds that they had in a session would have answered,
// beside what they answered (pilot.md section 8). It is shown and never judged: a person's Weber fraction of interval
// is not known, that of amplitude only where they compared strengths.
//
// Thread-safety: pure functions.
#pragma once

#include "app/report/Captions.h"
#include "app/report/ReportContent.h"
#include "app/report/StudyOverSessions.h"

namespace tacto {

/// `weber`: their own, of amplitude; NaN where it was not measured. Nothing where the session has no detection
/// threshold, or some condition was not presented in its test. Errors: as VirtualObserver::create().
[[nodiscard]] Result<void> addPredicted(std::vector<ReportBlock>& blocks, Captions& captions, const QString& caption,
                                        const AnalysedSession& one, double weber, bool massager);

}  // namespace tacto
