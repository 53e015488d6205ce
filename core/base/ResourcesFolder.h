// ResourcesFolder.h - where the program's resources lie: protocols/, examples/, words/, additional limit sets.
//
// Thread-safety: reads the environment and folders; any thread.
#pragma once

#include <filesystem>

#include "core/base/Result.h"

namespace tacto {

/// Returns $TACTOSCOPE_RESOURCES; else `resources` next to or above the executable (a build inside the source tree);
/// else the installed share folder. Errors: NotFound naming the folders that were tried.
[[nodiscard]] Result<std::filesystem::path> resourcesFolder();

}  // namespace tacto
