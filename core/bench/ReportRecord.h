// ReportRecord.h - a device's report on itself as an event of the session: "device report", its rows as fields.
//
// Thread-safety: as SessionRecorder::event(). Never allocates.
#pragma once

#include <string_view>

#include "core/devices/DeviceReport.h"
#include "core/session/SessionRecorder.h"

namespace tacto {

void recordReport(SessionRecorder& recorder, Instant at, const DeviceReport& report, std::string_view text) noexcept;

}  // namespace tacto
