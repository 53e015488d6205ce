// CaptureFile.h - writes captures as plain CSV, `time_s,voltage_v,current_a`. core/formats/ reads these files and those
// of other makers.
//
// The first column is the time, and every other column is a channel. Its suffix gives the unit (`_v _a`); without a
// suffix it holds logic levels or bare numbers. The input range, resolution and trigger moment are not in the file.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/measure/Capture.h"

namespace tacto {

/// Writes `capture`, replacing the file as a whole. Times have enough digits for a thousandth of a step; samples read
/// back unchanged. Errors: those of checkWritable(); Io with the system's reason.
[[nodiscard]] Result<void> writeCapture(const std::filesystem::path& path, const Capture& capture);

/// Checks that a file can hold the capture. Errors: InvalidArgument for no samples, no rate or unequal channel lengths.
[[nodiscard]] Result<void> checkWritable(const Capture& capture);

/// Finds a channel by its name ("voltage") or its column name ("voltage_v"); case does not matter. Errors: NotFound
/// listing the existing channels.
[[nodiscard]] Result<std::size_t> findChannel(const Capture& capture, std::string_view name);

/// Turns a channel of volts across a shunt into the current through it: samples, range, resolution and tolerances.
/// Without a name, converts the only channel in volts. Errors: InvalidArgument when the shunt is not above zero, the
/// channel is not in volts, or several are and none was named; NotFound.
[[nodiscard]] Result<void> convertShunt(Capture& capture, std::optional<std::string_view> channel, Ohms shunt);

}  // namespace tacto
