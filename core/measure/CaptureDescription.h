// CaptureDescription.h - describes a capture without its samples, as JSON. The description is stored next to the
// samples in a session. In a capture file of this program it is one comment line below the column names:
//
//   time_s,voltage_v,current_a
//   # tactoscope {"channels":[{"gain_tolerance":0.005,"high":52,"low":-52,"lsb":0.025,...}],"simulated":true,...}
//
// A figure that is not stated is null.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

/// Returns {"rate_hz", "start_s", "trigger_s", "simulated", "timebase_tolerance", "stamp_tolerance_s", "channels":
/// [{"name", "unit", "low", "high", "lsb", "gain_tolerance", "offset_tolerance", "linearity_tolerance",
/// "probe_tolerance", "stated_by"}]}
[[nodiscard]] nlohmann::json describeCapture(const Capture& capture);

/// Returns the capture that `description` describes, without samples. Missing parts are not stated. Returns nothing if
/// there is no list of channels. Never throws, whatever the JSON.
[[nodiscard]] std::optional<Capture> captureDescribed(const nlohmann::json& description);

/// Returns the comment line with its line end. Returns an empty text for a capture with nothing stated, because "not
/// simulated" would then be a claim without a source.
[[nodiscard]] std::string captureHeader(const Capture& capture);

/// Returns the header in `text`, the beginning of a file, or nothing if it has no readable header.
[[nodiscard]] std::optional<Capture> headerIn(std::string_view text);

/// Copies the trigger and origin from `header` into `capture`, which was read from a file. If both have the same
/// channels, copies their ranges, steps and tolerances too.
void takeHeader(Capture& capture, const Capture& header);

// The origin of a capture file, measured or simulated: from the file's own header and from origin.json in its folder,
// since some formats hold only plain numbers (hazard H9).

/// Writes {"simulated": …} into `folder`, once. If the folder already has a statement, an equal one stays; one that
/// differs becomes "simulated". Errors: Io.
[[nodiscard]] Result<void> stateCaptureOrigin(const std::filesystem::path& folder, bool simulated);

/// Returns whether the header of `file` (CaptureDescription.h) or its folder says that it is simulated. Returns nothing
/// if neither has a readable statement: the origin is then unknown.
[[nodiscard]] std::optional<bool> statedSimulated(const std::filesystem::path& file);

}  // namespace tacto
