// RecordingUnits.h - units in files of sensor data, and their spellings: "m/s²", "m·s⁻²", "mN", "µs".
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Stream.h"

namespace tacto {

struct RecordedUnit {
    StreamKind kind;
    StreamUnit unit;      ///< unit after conversion
    double factor;        ///< factor from the file's number to `unit`
    const char* spelled;  ///< spelling in recording.json
};

/// Returns the unit for a stream of this kind, in any spelling; nothing for other units. Case matters: mN is not MN.
[[nodiscard]] std::optional<RecordedUnit> recordedUnit(StreamKind kind, std::string_view text);
/// Returns the units that recordedUnit() accepts.
[[nodiscard]] std::vector<std::string_view> unitsOf(StreamKind kind);

/// Returns the kind that has a unit other than count; nothing for no such unit.
[[nodiscard]] std::optional<StreamKind> kindByUnit(std::string_view text);
/// Guesses what a channel holds from its name in small letters: "acc_x", "fz", "taxel 12".
[[nodiscard]] std::optional<StreamKind> kindByName(std::string_view name);

struct RecordedTimeUnit {
    double perSecond;
    const char* spelled;
};
[[nodiscard]] std::optional<RecordedTimeUnit> recordedTimeUnit(std::string_view text);
inline constexpr const char* kRecordedTimeUnits = "s, ms, us or ns";

/// The parts of a column's name in a header: "Fz (mN)", "acc_x [m/s²]", "t in ms", "t/ms", "force_N".
struct HeaderName {
    std::string_view name;  ///< name without the unit
    std::string_view unit;  ///< unit as written; empty if the header states no known unit
};
[[nodiscard]] HeaderName headerName(std::string_view text);

}  // namespace tacto
