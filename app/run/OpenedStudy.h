// OpenedStudy.h - the study that a pilot run belongs to, open to be changed, and the participant who comes.
//
// A rehearsal is made where there is no study and the participant is virtual; in a rehearsal a virtual participant is
// enrolled, and consents, by itself. A study with people does neither.
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
    std::vector<std::string> remarks;  ///< actions taken without being asked, a sentence each
};

/// As `pilot` and the settings of `order` say. Errors: NotFound for a study, code or passphrase that cannot be used and
/// a person without a window; kGateRefused for devices, modality and a number of blocks that the study does not have.
[[nodiscard]] Result<OpenedStudy> openStudyFor(const RunOrder& order, const PilotOrder& pilot);

}  // namespace tacto
