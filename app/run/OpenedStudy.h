// OpenedStudy.h - opens the study of a pilot run for changes, and finds the participant.
//
// If there is no study and the participant is virtual, a rehearsal is made. In a rehearsal, virtual participants are
// enrolled and give consent automatically; in a study with people this never happens.
//
// Thread-safety: one caller at a time for a study.
#pragma once

#include <string>
#include <vector>

#include "app/run/PilotOrder.h"
#include "app/run/ProtocolRun.h"
#include "core/study/Study.h"

namespace tacto {

struct OpenedStudy {
    Study study;
    Participant who;
    std::vector<std::string> remarks;  ///< actions taken automatically, one sentence each
};

/// Opens what `pilot` and the settings of `order` name. Errors: NotFound for a study, code or passphrase that cannot be
/// used, and for a person without a window; kGateRefused for devices, modality or a number of blocks not in the study.
[[nodiscard]] Result<OpenedStudy> openStudyFor(const RunOrder& order, const PilotOrder& pilot);

}  // namespace tacto
