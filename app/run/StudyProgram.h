// StudyProgram.h - what a study's approval states about this program and the profile of its sessions.
//
// Thread-safety: pure, except for the files of the limit sets.
#pragma once

#include <filesystem>

#include "core/bench/Profile.h"
#include "core/study/StudySettings.h"

namespace tacto {

/// Sets the study's electrode and its only kind of train in `profile`.
void fitProfile(Profile& profile, const StudySettings& study);
/// The task of a session's script.
struct AskedProcedure {
    DetectionMethod method = DetectionMethod::Quest;
    bool comparison = false;
};
/// Returns the stimuli of `profile` for people in this study, and the questions to them.
[[nodiscard]] StudyProcedure procedureOf(const Profile& profile, const StudySettings& study,
                                         const AskedProcedure& asked);

/// Fills in `limits`, `scripts`, `words` (also of the study's `folder`) and `procedure`; what is asked stays as it is.
/// Errors: as shippedLimits() and languagesOf(); InvalidArgument for a train that the profile cannot give, which every
/// session would refuse.
[[nodiscard]] Result<void> stateProgram(StudySettings& settings, const Profile& profile,
                                        const std::filesystem::path& folder = {});

}  // namespace tacto
