// FaultSchedule.h - what goes wrong with a simulated device, and when: one mechanism for all of them.
//
// A fault is written `fault=NAME`, `fault=NAME@12s` (from then on) or `fault=NAME@12s..15s` (and gone again). Times are
// the session's clock. Whether a fault is active is a function of time alone, so polling does not change it.
//
// Thread-safety: const after parsing.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto::sim {

enum class Fault {
    Unplug,   ///< every call fails with Device; a sensor sends nothing more
    Stale,    ///< no new data come, and no error
    Dropout,  ///< packets are lost
    Nan,      ///< values are not numbers
    Garbage,  ///< replies fail their check
    Drift,    ///< values or output wander off
    Stuck,    ///< values stand still while stamps go on
    StuckOn,  ///< output does not end by itself
    Open,     ///< electrode lifted
    Short,    ///< electrodes touch
    Late,     ///< replies take longer than anyone waits
};
[[nodiscard]] std::string_view nameOf(Fault fault) noexcept;  // "unplug", "stuck-on", ...

class FaultSchedule {
public:
    /// Adds one `NAME[@FROM[..TO]]`. Errors: InvalidArgument naming the text and what this device accepts.
    [[nodiscard]] Result<void> add(std::string_view text, std::initializer_list<Fault> accepted);

    [[nodiscard]] bool active(Fault fault, Instant now) const noexcept { return since(fault, now).has_value(); }
    /// When the stretch that is active now began.
    [[nodiscard]] std::optional<Instant> since(Fault fault, Instant now) const noexcept;
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
