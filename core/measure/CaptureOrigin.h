// CaptureOrigin.h - whether the captures of a folder were measured or simulated: origin.json beside them, since their
// columns are plain numbers that any program reads (hazard H9).
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <optional>

#include "core/base/Result.h"

namespace tacto {

/// Writes {"simulated": …} into `folder`, once: what stands there already stays when it says the same, and becomes
/// "simulated" when it does not. Errors: Io.
[[nodiscard]] Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated);

/// What the folder of `file` says of it. Nothing: it says nothing that can be read, so the origin is unknown.
[[nodiscard]] std::optional<bool> statedSimulated(const std::filesystem::path& file);

}  // namespace tacto
