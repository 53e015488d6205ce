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
    const char* spelled;  ///< as recording.json has it
};

/// The unit of a stream of that kind, however it is written; nothing for another one. Capitals count: mN is not MN.
[[nodiscard]] std::optional<RecordedUnit> recordedUnit(StreamKind kind, std::string_view text);
/// As recordedUnit() takes them.
[[nodiscard]] std::vector<std::string_view> unitsOf(StreamKind kind);

struct RecordedTimeUnit {
    double perSecond;
    const char* spelled;
};
[[nodiscard]] std::optional<RecordedTimeUnit> recordedTimeUnit(std::string_view text);
inline constexpr const char* kRecordedTimeUnits = "s, ms, us or ns";

/// What a header calls a column: "Fz (mN)", "acc_x [m/s²]", "t in ms", "t/ms", "force_N".
struct HeaderName {
    std::string_view name;  ///< without the unit
    std::string_view unit;  ///< as written; empty where the header states none that is known
};
[[nodiscard]] HeaderName headerName(std::string_view text);

}  // namespace tacto
