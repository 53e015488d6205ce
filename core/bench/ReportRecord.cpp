#include "core/bench/ReportRecord.h"

#include <array>

namespace tacto {

static_assert(DeviceReport::kMaxRows <= SessionRecorder::kMaxFields);

void recordReport(SessionRecorder& recorder, Instant at, const DeviceReport& report, std::string_view text) noexcept {
    std::array<RecordField, DeviceReport::kMaxRows> fields{};
    std::size_t count = 0;
    for (const auto& row : report.rows()) fields[count++] = {row.key, row.value};
    recorder.event(at, "device report", std::span<const RecordField>(fields.data(), count), text);
}

}  // namespace tacto
