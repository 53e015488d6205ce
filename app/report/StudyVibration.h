// StudyVibration.h - what a massager's motor did in a session, beside what it was commanded to do.
//
// Thread-safety: pure functions.
#pragma once

#include "app/report/Captions.h"
#include "app/report/ReportContent.h"
#include "core/sharing/BidsStudy.h"

namespace tacto {

/// One sentence where no accelerometer was on it. Errors: as judgeVibration().
[[nodiscard]] Result<void> addVibration(std::vector<ReportBlock>& blocks, Captions& captions,
                                        const BidsSession& session, const std::string& name);

}  // namespace tacto
