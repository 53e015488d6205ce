// CaptureDescription.h - what a capture is besides its samples, as JSON: beside its samples in a session, and in the
// header of a capture file that this program wrote, as one comment line after the line of column names:
//
//   time_s,voltage_v,current_a
//   # tactoscope {"channels":[{"gain_tolerance":0.005,"high":52,"low":-52,"lsb":0.025,...}],"simulated":true,...}
//
// A figure that was not stated is null.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

/// {"rate_hz", "start_s", "trigger_s", "simulated", "timebase_tolerance", "stamp_tolerance_s", "channels": [{"name",
/// "unit", "low", "high", "lsb", "gain_tolerance", "offset_tolerance", "linearity_tolerance", "probe_tolerance",
/// "stated_by"}]}
[[nodiscard]] nlohmann::json describeCapture(const Capture& capture);

/// Takes over what `description` says, channels without samples. Missing parts stay not stated. No JSON makes it throw.
/// Nothing without a list of channels.
[[nodiscard]] std::optional<Capture> captureDescribed(const nlohmann::json& description);

/// The comment line, with its line end; empty for a capture with nothing stated: "not simulated" would then be a claim
/// without a source.
[[nodiscard]] std::string captureHeader(const Capture& capture);

/// The header in `text`, a file's beginning; nothing where none can be read.
[[nodiscard]] std::optional<Capture> headerIn(std::string_view text);

/// Gives `capture`, as it was read from a file, what `header` says about it: trigger, origin and, where both have the
/// same channels, their ranges, steps and tolerances.
void takeHeader(Capture& capture, const Capture& header);

// Whether a capture file was measured or simulated: by its own header, and by origin.json beside it,
// for the formats whose columns are plain numbers (hazard H9).

/// Writes {"simulated": …} into `folder`, once: what stands there already stays when it says the same, and becomes
/// "simulated" when it does not. Errors: Io.
[[nodiscard]] Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated);

/// What the header of `file` (CaptureDescription.h) or its folder says about it. Nothing: neither says anything that
/// can be read, so the origin is unknown.
[[nodiscard]] std::optional<bool> statedSimulated(const std::filesystem::path& file);

}  // namespace tacto
