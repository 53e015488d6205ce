// StatementKeys.h - the keys of a device's address that state how accurate its oscilloscope is.
//
//   sigrok:rigol-ds:conn=...?shunt=100ohm&gain_pct=2&probe_pct=1&shunt_pct=0.1&timebase_ppm=50
//   capture:FOLDER?gain_pct=2&probe_pct=0&shunt_pct=0.1&timebase_ppm=50
//
// gain_pct (both channels, of the reading), fs_pct (of full scale: for data sheets that state the gain so), offset_v,
// offset_a, probe_pct (0: a plain cable), shunt_pct, timebase_ppm, stamp_s (of separate records against each other),
// lsb_v and lsb_a (one step, for files that do not say).
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/Result.h"
#include "core/devices/DeviceUri.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

/// Whether `key` is one of those keys.
[[nodiscard]] bool statesAccuracy(std::string_view key) noexcept;

/// Takes those keys out of `uri`; nothing where it has none. Errors: InvalidArgument naming the key, its value and what
/// is accepted, or a key that stands twice.
[[nodiscard]] Result<std::optional<InstrumentStatement>> takeStatement(DeviceUri& uri);

}  // namespace tacto
