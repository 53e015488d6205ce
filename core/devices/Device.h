// Device.h - the common part of every device. A device is opened by its driver, owned by one session thread and closed
// by destruction. The interfaces below that it implements show what it can do; a missing ability is a missing
// interface.
//
// Thread-safety: identity() is constant while the device is open; the rest as each interface states.
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
    std::string uri;  ///< the address that opens this device again
    Role role;
    std::string name;
    std::string serial;
    std::string firmware;
    bool simulated = false;
    /// One sentence: why a listed device cannot be opened now and what helps; empty if it can be opened.
    std::string obstacle = {};
    bool placeholder = false;  ///< listed as a kind of device: the user must complete the path of `uri`
    bool operator==(const DeviceIdentity&) const = default;
};

class Device {
public:
    virtual ~Device() = default;
    [[nodiscard]] virtual const DeviceIdentity& identity() const noexcept = 0;
};

// A device that replays earlier data: a recording, captures in files. Only its files can say whether the data were
// measured or simulated (hazard H9).

enum class StatedOrigin { NotStated, Measured, Simulated };

/// Implemented, in addition to Device, by replaying devices; DeviceIdentity::simulated is set for origin Simulated.
class ReplayedDevice {
public:
    virtual ~ReplayedDevice() = default;
    [[nodiscard]] virtual StatedOrigin statedOrigin() const noexcept = 0;
};

// The error for an order that a driver receives after its approval expired.

/// `who` is the device within a sentence, `what` the train or burst: "the stimulator", "a train". Errors: Timeout if
/// `expires` is before `now`.
[[nodiscard]] inline Result<void> notExpired(Instant expires, Instant now, std::string_view who,
                                             std::string_view what) {
    if (now <= expires) return {};
    return fail(ErrorCode::Timeout, "{} refused {} whose approval expired {:.1f} ms ago", who, what,
                toSeconds(now - expires) * 1e3);
}

// A device's report on itself and its line since it was opened: losses, clock drift, delays. Sessions store its rows
// and windows show them. Devices that can report this also implement ReportingDevice.

/// The texts must be literals, because they are kept as pointers.
struct ReportRow {
    const char* key = "";   ///< the key in sessions and JSON, with its unit: "drift_ppm"
    const char* name = "";  ///< the name for people: "clock drift"
    double value = 0;       ///< NaN: unknown
    const char* unit = "";  ///< the unit shown to people; empty for a count
};

struct DeviceReport {
    static constexpr std::size_t kMaxRows = 12;  ///< as many as an event of a session can hold

    /// Ignores rows beyond kMaxRows.
    constexpr void add(const ReportRow& row) noexcept {
        if (count < kMaxRows) all[count++] = row;
    }
    [[nodiscard]] std::span<const ReportRow> rows() const noexcept { return {all.data(), count}; }

    std::uint64_t losses = 0;  ///< lost or damaged items so far; the operator should learn of any increase
    std::array<ReportRow, kMaxRows> all{};
    std::size_t count = 0;
};

class ReportingDevice {
public:
    virtual ~ReportingDevice() = default;
    [[nodiscard]] virtual DeviceReport deviceReport() const noexcept = 0;
};

}  // namespace tacto
