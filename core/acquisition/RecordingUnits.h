// RecordingUnits.h - the units that files of sensor data have, and how they are written: "m/s²", "m·s⁻²", "mN", "µs".
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
    StreamUnit unit;      ///< after conversion
    double factor;        ///< the file's number times this is in `unit`
    const char* spelled;  ///< the spelling in recording.json
};

/// The unit of a stream of that kind, in any spelling; nothing for another unit. Capitals count: mN is not MN.
[[nodiscard]] std::optional<RecordedUnit> recordedUnit(StreamKind kind, std::string_view text);
/// The units that recordedUnit() takes.
[[nodiscard]] std::vector<std::string_view> unitsOf(StreamKind kind);

struct RecordedTimeUnit {
    double perSecond;
    const char* spelled;
};
[[nodiscard]] std::optional<RecordedTimeUnit> recordedTimeUnit(std::string_view text);
inline constexpr const char* kRecordedTimeUnits = "s, ms, us or ns";

/// The parts of a header's name for a column: "Fz (mN)", "acc_x [m/s²]", "t in ms", "t/ms", "force_N".
struct HeaderName {
    std::string_view name;  ///< the name without the unit
    std::string_view unit;  ///< as written; empty where the header states no known one
};
[[nodiscard]] HeaderName headerName(std::string_view text);

}  // namespace tacto
