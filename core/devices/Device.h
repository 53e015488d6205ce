// Device.h - what every device has. A device is opened by its driver, owned by one session thread and
// closed by destruction. What it can do is which of the interfaces below it implements: a missing
// ability is a missing interface.
//
// Thread-safety: identity() is constant while the device is open; the rest as its interface says.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto {

struct DeviceIdentity {
    std::string uri;  ///< opens this device again
    Role role;
    std::string name;
    std::string serial;
    std::string firmware;
    bool simulated = false;
    /// Why a listed device cannot be opened now and what helps, one sentence; empty where it can.
    std::string obstacle = {};
    bool placeholder = false;  ///< listed as a kind: the path of `uri` has to be filled in
    bool operator==(const DeviceIdentity&) const = default;
};

class Device {
public:
    virtual ~Device() = default;
    [[nodiscard]] virtual const DeviceIdentity& identity() const noexcept = 0;
};

// A device that gives back what was taken before: a recording, captures in files. Whether that was
// measured or simulated only its files can say (hazard H9).

enum class StatedOrigin { NotStated, Measured, Simulated };

/// Implemented beside Device by those that replay; DeviceIdentity::simulated is set where it is Simulated.
class ReplayedDevice {
public:
    virtual ~ReplayedDevice() = default;
    [[nodiscard]] virtual StatedOrigin statedOrigin() const noexcept = 0;
};

// The error for what a driver was handed after its approval had expired.

/// `who` is the device within a sentence, `what` the train or burst: "the stimulator", "a train". Errors: Timeout where
/// `expires` is before `now`.
[[nodiscard]] inline Result<void> notExpired(Instant expires, Instant now, std::string_view who,
                                             std::string_view what) {
    if (now <= expires) return {};
    return fail(ErrorCode::Timeout, "{} refused {} whose approval expired {:.1f} ms ago", who, what,
                toSeconds(now - expires) * 1e3);
}

// What a device and its line have been like since it was opened, as rows that a session keeps and a
// window shows: losses, clock drift, delays. A device that knows such things of itself is a ReportingDevice as well.

/// The texts live forever: literals.
struct ReportRow {
    const char* key = "";   ///< the key in sessions and JSON, with its unit: "drift_ppm"
    const char* name = "";  ///< the name that people read: "clock drift"
    double value = 0;       ///< NaN: not known
    const char* unit = "";  ///< the unit that people read; empty for a count
};

struct DeviceReport {
    static constexpr std::size_t kMaxRows = 12;  ///< as many as fit into an event of a session

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
