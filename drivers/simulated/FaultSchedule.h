// FaultSchedule.h - which faults a simulated device has, and when; the same mechanism for all devices.
//
// A fault is written `fault=NAME`, `fault=NAME@12s` (from then on) or `fault=NAME@12s..15s` (until then). Times are
// those of the session's clock. Only the time decides whether a fault is active, so polling changes nothing.
//
// Thread-safety: constant after parsing.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto::sim {

enum class Fault {
    Unplug,   ///< every call fails with Device; a sensor sends no more data
    Stale,    ///< no new data, and no error
    Dropout,  ///< packets are lost
    Nan,      ///< values are not numbers
    Garbage,  ///< replies fail their checksum
    Drift,    ///< values or output drift away
    Stuck,    ///< values stay constant while time stamps go on
    StuckOn,  ///< output does not end by itself
    Open,     ///< an electrode has come off
    Short,    ///< electrodes touch
    Late,     ///< replies come after the caller's timeout
};
[[nodiscard]] std::string_view nameOf(Fault fault) noexcept;  // "unplug", "stuck-on", ...

class FaultSchedule {
public:
    /// Adds one fault, `NAME[@FROM[..TO]]`. Errors: InvalidArgument naming the text and what this device accepts.
    [[nodiscard]] Result<void> add(std::string_view text, std::initializer_list<Fault> accepted);

    [[nodiscard]] bool active(Fault fault, Instant now) const noexcept { return since(fault, now).has_value(); }
    /// Returns when the active period of `fault` began, or nothing if it is not active at `now`.
    [[nodiscard]] std::optional<Instant> since(Fault fault, Instant now) const noexcept;
    /// Errors: Device while `device` ("stimulator") is unplugged; of one that stays so it says what brings it back.
    [[nodiscard]] Result<void> plugged(std::string_view device, Instant now) const;
    [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }

private:
    struct Entry {
        Fault fault;
        Instant from;
        Instant to;
    };
    std::vector<Entry> entries_;
};

}  // namespace tacto::sim
