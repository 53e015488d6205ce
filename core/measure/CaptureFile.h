// CaptureFile.h - this project's own captures on disk: plain CSV, `time_s,voltage_v,current_a`. Reading them, and other
// makers' files, is in core/formats/.
//
// The first column is time, every other one a channel; a suffix says the unit (`_v _a`), none means a logic level or a
// bare number. The input range, resolution and trigger moment are not in the file.
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

/// Writes `capture`, replacing the file by a whole one. Times carry enough digits for a thousandth of a step, samples
/// round-trip. Errors: those of checkWritable(); Io with the system's reason.
[[nodiscard]] Result<void> writeCapture(const std::filesystem::path& path, const Capture& capture);

/// Whether a file can hold it. Errors: InvalidArgument when it has no samples, no rate or channels of unequal length.
[[nodiscard]] Result<void> checkWritable(const Capture& capture);

/// The channel called `name`: its name ("voltage"), or its column name ("voltage_v"), capitals ignored.
/// Errors: NotFound listing the channels there are.
[[nodiscard]] Result<std::size_t> findChannel(const Capture& capture, std::string_view name);

/// Turns a channel of volts across a shunt into the current through it: samples, range, resolution and tolerances.
/// Without a name it is the only channel in volts.
/// Errors: InvalidArgument when the shunt is not above zero, the channel is not in volts, or several are and none was
/// named; NotFound.
[[nodiscard]] Result<void> convertShunt(Capture& capture, std::optional<std::string_view> channel, Ohms shunt);

}  // namespace tacto
