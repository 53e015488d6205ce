// StudyProgram.h - what a study's approval says about this program and the profile that its sessions are run with.
//
// Thread-safety: pure but for the limit sets' files.
#pragma once

#include "core/bench/Profile.h"
#include "core/study/StudySettings.h"

namespace tacto {

/// `profile` with the electrode and the one kind of train of the study.
void fitProfile(Profile& profile, const StudySettings& study);
/// The task of a session's script.
struct AskedProcedure {
    DetectionMethod method = DetectionMethod::Quest;
    bool comparison = false;
};
/// The stimuli of `profile` for people of this study, and the questions to them.
[[nodiscard]] StudyProcedure procedureOf(const Profile& profile, const StudySettings& study,
                                         const AskedProcedure& asked);

/// Fills in `limits`, `scripts` and `procedure`; what is asked stays as it is. Errors: as shippedLimits();
/// InvalidArgument for a train that the profile cannot give, which every session would refuse.
[[nodiscard]] Result<void> stateProgram(StudySettings& settings, const Profile& profile);

}  // namespace tacto
