// CaptureFile.h - this project's own captures on disk: plain CSV, `time_s,voltage_v,current_a`.
//
// The first column is time, every other one a channel; a suffix says the unit (`_v _mv _a _ma _ua`, or `(V)`, `[mA]`),
// no suffix means a logic level or a bare number. Everything becomes V and A on reading. Sampling rate and start come
// from the time stamps; the input range, resolution and trigger moment are not in the file and stay unknown, so
// clipping is then judged from the samples alone (see PulseMeasurement.h).
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/measure/Capture.h"

namespace tacto {

struct CaptureReading {
    Capture capture;                    ///< trigger_s is NaN
    std::vector<std::string> warnings;  ///< sentences: what was tolerated, with line numbers
    std::string formatId;               ///< which format it was: set by CaptureFormats::read()
    std::string formatName;             ///< likewise, for people
};

/// A field that is empty or says nan is a missing sample: dropped (with a warning where values were lost) at the end
/// of the record, NaN in its middle, where pulses that touch it are not measured.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected: a field that is no number, a row of the
/// wrong length, no time column, an unknown unit, time that does not rise in even steps (± half a step), fewer than
/// two rows.
[[nodiscard]] Result<CaptureReading> readCapture(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Result<CaptureReading> parseCapture(std::string_view text, std::string_view name);

/// Writes `capture`, replacing the file. Times carry enough digits for a thousandth of a step, samples round-trip.
/// Errors: InvalidArgument when it has no samples, no rate or channels of unequal length; Io.
[[nodiscard]] Result<void> writeCapture(const std::filesystem::path& path, const Capture& capture);

/// The channel called `name`: its name ("voltage"), or its column name ("voltage_v"), capitals ignored.
/// Errors: NotFound listing the channels there are.
[[nodiscard]] Result<std::size_t> findChannel(const Capture& capture, std::string_view name);

/// Turns a channel of volts across a shunt into the current through it: samples, range, resolution and tolerances.
/// Without a name it is the only channel in volts.
/// Errors: InvalidArgument when the shunt is not above zero, the channel is not in volts, or several are and none was
/// named; NotFound.
[[nodiscard]] Result<void> convertShunt(Capture& capture, std::optional<std::string_view> channel, Ohms shunt);

}  // namespace tacto
