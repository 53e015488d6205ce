// LoadCaptures.h - which train of a safety check's session shows what a limit was judged by on one of its loads.
//
// Thread-safety: pure functions; they read the session's file, and take as long as the disk does.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto::gui {

/// The highest finite magnitude of the first channel in `unit` ("V", "A"); negative without one.
[[nodiscard]] double peakIn(const Capture& capture, std::string_view unit);

/// The capture with the highest peak among the commands on `load` ("500 ohm"): of voltage for a limit in volts, else of
/// current, and of voltage again where no current was measured. Null where none was captured on that load.
/// Errors: as SessionReader.
[[nodiscard]] Result<std::shared_ptr<const Capture>> strongestOn(const std::filesystem::path& session,
                                                                 const std::string& load, bool ofVoltage);

}  // namespace tacto::gui
