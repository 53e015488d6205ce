// StudyProgram.h - what a new study's approval says of this program: its limit sets and its pilot protocols, by hash.
//
// Thread-safety: pure but for the limit sets' files.
#pragma once

#include "core/study/StudySettings.h"

namespace tacto {

/// Fills in `limits` and `scripts`. Errors: as shippedLimits().
[[nodiscard]] Result<void> stateProgram(StudySettings& settings);

}  // namespace tacto
