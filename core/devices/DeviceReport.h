// DeviceReport.h - what a device and its line have been like since it was opened, as rows that a session keeps and a
// window shows: losses, clock drift, delays. A device that knows such things of itself is a ReportingDevice as well.
//
// Thread-safety: report() any thread, while the device is open.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tacto {

/// The texts live forever: literals.
struct ReportRow {
    const char* key = "";   ///< in sessions and JSON, with its unit: "drift_ppm"
    const char* name = "";  ///< for people: "clock drift"
    double value = 0;       ///< NaN: not known
    const char* unit = "";  ///< for people; empty for a count
};

struct DeviceReport {
    static constexpr std::size_t kMaxRows = 12;  ///< as many as an event of a session takes

    /// More than kMaxRows are left out.
    constexpr void add(const ReportRow& row) noexcept {
        if (count < kMaxRows) all[count++] = row;
    }
    [[nodiscard]] std::span<const ReportRow> rows() const noexcept { return {all.data(), count}; }

    std::uint64_t losses = 0;  ///< things lost or spoilt so far: when it has grown, the operator should know
    std::array<ReportRow, kMaxRows> all{};
    std::size_t count = 0;
};

class ReportingDevice {
public:
    virtual ~ReportingDevice() = default;
    [[nodiscard]] virtual DeviceReport deviceReport() const noexcept = 0;
};

}  // namespace tacto
