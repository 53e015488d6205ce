// CaptureOrigin.h - whether a capture file was measured or simulated: by its own header, and by origin.json beside it,
// for the formats whose columns are plain numbers (hazard H9).
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

/// What the header of `file` (CaptureDescription.h) or its folder says about it. Nothing: neither says anything that
/// can be read, so the origin is unknown.
[[nodiscard]] std::optional<bool> statedSimulated(const std::filesystem::path& file);

}  // namespace tacto
