// StudyLock.h - one program at a time changes a study.
//
// Nothing is written to say who holds it: a program that changes nothing leaves the folder as it was.
//
// Thread-safety: any thread.
#pragma once

#include "core/base/Result.h"
#include "core/safety/LockedFile.h"
#include "core/study/StudyFiles.h"

namespace tacto {

/// Held as long as the value lives. Errors: Io naming the program that holds it, or that the lock cannot be taken.
[[nodiscard]] Result<LockedFile> lockStudy(const StudyFiles& files);

}  // namespace tacto
